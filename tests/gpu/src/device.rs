//! Adapters and their devices.

use wgpu::{Adapter, Backends, Instance, InstanceDescriptor};

/// An opened adapter.
#[derive(Clone)]
pub(crate) struct Gpu {
    pub(crate) name: String,
    /// Lower for adapters that are probably faster.
    pub(crate) rank: (usize, bool),
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
}

/// Opens every adapter of the primary APIs whose name contains a text. Returns an error if there is
/// none.
pub(crate) fn open(named: Option<&str>) -> Result<Vec<Gpu>, String> {
    let gpus = find(named, Backends::PRIMARY);
    if gpus.is_empty() { Err(none(named)) } else { Ok(gpus) }
}

/// Returns the message that there is no adapter, or none with a name.
pub(crate) fn none(named: Option<&str>) -> String {
    let named = named.map_or(String::new(), |name| format!(" whose name contains `{name}`"));
    format!(
        "no adapter{named} found (on Debian, `apt-get install mesa-vulkan-drivers libvulkan1` installs a software adapter)"
    )
}

/// Opens every adapter whose name contains a text.
pub(crate) fn find(named: Option<&str>, backends: Backends) -> Vec<Gpu> {
    let mut descriptor = InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backends;
    let adapters = pollster::block_on(Instance::new(descriptor).enumerate_adapters(backends));
    let named = |adapter: &Adapter| {
        named.is_none_or(|text| name(adapter).to_lowercase().contains(&text.to_lowercase()))
    };
    let mut gpus = Vec::new();
    for adapter in adapters.iter().filter(|adapter| named(adapter)) {
        // Two layers of a loader may find the same device.
        if gpus.iter().any(|gpu: &Gpu| gpu.name == name(adapter)) {
            continue;
        }
        match pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            required_limits: wgpu::Limits::downlevel_defaults().using_resolution(adapter.limits()),
            ..Default::default()
        })) {
            Ok((device, queue)) => {
                gpus.push(Gpu { name: name(adapter), rank: rank(adapter), device, queue });
            }
            Err(error) => println!("skipped {}: {error}", name(adapter)),
        }
    }
    gpus
}

fn rank(adapter: &Adapter) -> (usize, bool) {
    use wgpu::DeviceType::{Cpu, DiscreteGpu, IntegratedGpu, VirtualGpu};
    let kind = adapter.get_info().device_type;
    // Among software adapters, Mesa's takes a third of SwiftShader's time.
    let slow = !name(adapter).contains("llvmpipe");
    ([DiscreteGpu, IntegratedGpu, VirtualGpu, Cpu].iter().position(|of| *of == kind).unwrap_or(4), slow)
}

fn name(adapter: &Adapter) -> String {
    let info = adapter.get_info();
    format!(
        "{} ({:?}{}{})",
        info.name,
        info.backend,
        if info.driver_info.is_empty() { "" } else { ", " },
        info.driver_info
    )
}

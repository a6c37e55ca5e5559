//! Adapters and their devices.

use wgpu::{Adapter, Backends, Instance, InstanceDescriptor};

/// An adapter that has been opened.
pub(crate) struct Gpu {
    pub(crate) name: String,
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
}

/// Every adapter whose name contains a text, opened; the error says that there is none.
pub(crate) fn open(named: Option<&str>) -> Result<Vec<Gpu>, String> {
    let mut descriptor = InstanceDescriptor::new_without_display_handle();
    descriptor.backends = Backends::PRIMARY;
    let adapters = pollster::block_on(Instance::new(descriptor).enumerate_adapters(Backends::PRIMARY));
    let named = |adapter: &Adapter| {
        named.is_none_or(|text| name(adapter).to_lowercase().contains(&text.to_lowercase()))
    };
    let mut gpus = Vec::new();
    for adapter in adapters.iter().filter(|adapter| named(adapter)) {
        match pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            required_limits: wgpu::Limits::downlevel_defaults().using_resolution(adapter.limits()),
            ..Default::default()
        })) {
            Ok((device, queue)) => gpus.push(Gpu { name: name(adapter), device, queue }),
            Err(error) => println!("{} is left out: {error}", name(adapter)),
        }
    }
    if gpus.is_empty() {
        return Err(
            "no adapter was found; on Debian `apt-get install mesa-vulkan-drivers libvulkan1` brings one \
                    in software"
                .into(),
        );
    }
    Ok(gpus)
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

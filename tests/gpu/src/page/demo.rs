//! A shader that shows what a part computes: one of its functions over a square, as colour.

use asperity_shader_tests::case::Case;
use asperity_shaders::{Binding, Bindings, Part, compose, ordered};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Function, Handle, Module, ScalarKind, Type, TypeInner};

/// A shader that calls a function of a part.
pub(super) struct Demo {
    /// The part, or those that the shader of a case joins with it.
    pub(super) parts: Vec<&'static Part>,
    /// Name of the function that is called.
    pub(super) function: String,
    /// The call.
    pub(super) call: String,
    /// `shown` of what the call gives, in WGSL.
    pub(super) colour: String,
}

/// The fragment shader's entry.
pub(super) const FRAGMENT: &str = "
@fragment
fn show_part(@location(0) at: vec3<f32>) -> @location(0) vec4<f32> {
    return vec4<f32>(shown(at), 1.0);
}
";

/// A compute shader's entry of the name that engines expect, which fills an image.
pub(super) const COMPUTE: &str = "
@group(1) @binding(0) var shown_image: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(shown_image);
    if id.x < size.x && id.y < size.y {
        let at = vec3<f32>((vec2<f32>(id.xy) + 0.5) / vec2<f32>(size), 0.5);
        textureStore(shown_image, vec2<i32>(id.xy), vec4<f32>(shown(at), 1.0));
    }
}
";

impl Demo {
    /// Of a part, alone or as one of the cases that call it joins it with uniforms; `None` where no function takes what can be thought of.
    pub(super) fn new(part: &'static Part, cases: &[&Case]) -> Result<Option<Self>, String> {
        let mut best = Self::of(part, vec![part])?;
        for case in cases {
            if let Some((worth, demo)) = Self::of(part, case.parts.clone())?
                && best.as_ref().is_none_or(|(most, _)| worth > most + OWN)
            {
                best = Some((worth, demo));
            }
        }
        Ok(best.map(|(_, demo)| demo))
    }

    /// The module without an entry.
    pub(super) fn wgsl(&self) -> String {
        let Self { call, colour, .. } = self;
        let parts = compose(&self.parts, Bindings::Textures { group: 0 });
        format!(
            "{parts}\n// A square of the part's function, at in [0, 1].\n\
             fn shown(at: vec3<f32>) -> vec3<f32> {{\n    let result = {call};\n    return {colour};\n}}\n"
        )
    }

    /// The function that is the most worth to be shown, and its worth.
    fn of(part: &'static Part, parts: Vec<&'static Part>) -> Result<Option<(i32, Self)>, String> {
        let wgsl = compose(&parts, Bindings::Textures { group: 0 });
        let module = naga::front::wgsl::parse_str(&wgsl).map_err(|error| error.emit_to_string(&wgsl))?;
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        let info = validator.validate(&module).map_err(|error| error.emit_to_string(&wgsl))?;
        let own: Vec<&str> = part.names().collect();
        let uniforms: Vec<(&str, &str)> = ordered(&parts)
            .iter()
            .flat_map(|part| part.bindings())
            .filter_map(|binding| match *binding {
                Binding::Uniform { name, of } => Some((name, of)),
                _ => None,
            })
            .collect();
        let stem = part.name().rsplit('/').next().unwrap_or_default();
        let mut best: Option<(i32, Self)> = None;
        for (handle, function) in module.functions.iter() {
            let Some(name) = function.name.as_deref().filter(|name| own.contains(name)) else { continue };
            let Some(call) = call(&module, name, function, &uniforms) else { continue };
            let Some(result) = &function.result else { continue };
            let signed = part.name().starts_with("noise/");
            let Some(colour) = colour(&module, result.ty, "result", signed) else { continue };
            let worth = worth(&module, &info, handle, name, stem);
            if best.as_ref().is_none_or(|(most, _)| worth > *most) {
                let (parts, function) = (parts.clone(), name.to_owned());
                best = Some((worth, Self { parts, function, call, colour }));
            }
        }
        Ok(best)
    }
}

/// Worth by which a function that needs uniforms of one's own must be better.
const OWN: i32 = 50;

/// Functions that read all that the module is bound to come first, then those named after the file, and those that have a look.
fn worth(module: &Module, info: &ModuleInfo, handle: Handle<Function>, name: &str, stem: &str) -> i32 {
    let used = module.global_variables.iter().filter(|(global, _)| !info[handle][*global].is_empty()).count();
    let has = |text: &str| i32::from(name.contains(text));
    let shown: i32 =
        ["_noise", "_octaves", "density", "exact_ggx", "colour", "_value", "_height"].map(has).iter().sum();
    let inner =
        ["_in_cell", "_layer", "_place", "_total", "_corner", "_ends", "_is_", "_bits", "_normal", "_inside"];
    let inner: i32 = inner.map(has).iter().sum();
    100 * used as i32 + 40 * i32::from(name == stem) + 10 * has(stem) + 6 * has("_3d") + 15 * shown
        - 20 * inner
}

/// The call of a function with arguments over the square.
fn call(module: &Module, name: &str, function: &Function, uniforms: &[(&str, &str)]) -> Option<String> {
    let arguments: Option<Vec<String>> = function
        .arguments
        .iter()
        .map(|argument| {
            argument_of(module, argument.name.as_deref().unwrap_or_default(), argument.ty, uniforms)
        })
        .collect();
    Some(format!("{name}({})", arguments?.join(", ")))
}

fn argument_of(module: &Module, name: &str, ty: Handle<Type>, uniforms: &[(&str, &str)]) -> Option<String> {
    let ty = &module.types[ty];
    let text = match ty.inner {
        TypeInner::Scalar(scalar) => match (scalar.kind, name) {
            (ScalarKind::Float, "octaves") => "6.0",
            (ScalarKind::Float, "footprint" | "width") => "0.002",
            (ScalarKind::Float, "weight" | "jitter" | "gain") => "0.9",
            (ScalarKind::Float, "eta") => "1.5",
            (ScalarKind::Float, "k") => "3.0",
            (ScalarKind::Float, "nu" | "exponent") => "4.0",
            (ScalarKind::Float, "alpha" | "roughness") => "0.3",
            (ScalarKind::Float, "footprint_width") => "0.01",
            (ScalarKind::Float, _) => "at.x",
            (ScalarKind::Uint, "key") => "7u",
            (ScalarKind::Uint, "sum" | "metric" | "basis") => "0u",
            (ScalarKind::Uint, "terms") => "u32(at.x * 64.0)",
            (ScalarKind::Uint, _) => "1u",
            (ScalarKind::Sint, _) => "i32(at.x * 8.0)",
            (ScalarKind::Bool, _) => "true",
            _ => return None,
        },
        TypeInner::Vector { size, scalar } => match (size as u8, scalar.kind, name) {
            (2, ScalarKind::Float, "alpha") => "vec2<f32>(0.2, 0.4)",
            (2, ScalarKind::Float, "p" | "q") => "at.xy * 8.0",
            (2, ScalarKind::Float, "z" | "zeta" | "gaussian") => "at.xy * 4.0 - 2.0",
            (2, ScalarKind::Float, "within") => "vec2<f32>(0.0, 1e30)",
            (2, ScalarKind::Float, _) => "at.xy",
            (3, ScalarKind::Float, "p" | "q" | "position") => "at * 8.0",
            (3, ScalarKind::Float, "wi") => "normalize(vec3<f32>(0.3, 0.4, 0.8))",
            (3, ScalarKind::Float, "m" | "n" | "h" | "wo" | "w" | "normal" | "v") => {
                "normalize(vec3<f32>(at.xy * 2.0 - 1.0, 1.0))"
            }
            (3, ScalarKind::Float, "origin" | "eye") => "vec3<f32>(at.xy * 2.0, 9.0)",
            (3, ScalarKind::Float, "direction") => "vec3<f32>(0.0, 0.0, -1.0)",
            (3, ScalarKind::Float, _) => "at",
            (4, ScalarKind::Float, "p" | "q") => "vec4<f32>(at, 0.5) * 8.0",
            (4, ScalarKind::Float, _) => "vec4<f32>(at, 0.5)",
            (2, ScalarKind::Sint, _) => "vec2<i32>(at.xy * 8.0)",
            (3, ScalarKind::Sint, _) => "vec3<i32>(at * 8.0)",
            (4, ScalarKind::Sint, _) => "vec4<i32>(vec4<f32>(at, 0.5) * 8.0)",
            (2, ScalarKind::Uint, _) => "vec2<u32>(at.xy * 64.0)",
            (3, ScalarKind::Uint, _) => "vec3<u32>(at * 64.0)",
            (4, ScalarKind::Uint, _) => "vec4<u32>(vec4<f32>(at, 0.5) * 64.0)",
            _ => return None,
        },
        TypeInner::Struct { .. } => return structure(module, ty.name.as_deref()?, uniforms),
        _ => return None,
    };
    Some(text.into())
}

/// A structure that a uniform holds, or that is easily made.
fn structure(module: &Module, name: &str, uniforms: &[(&str, &str)]) -> Option<String> {
    match name {
        "SurfacePoint" => {
            return Some(
                "SurfacePoint(vec3<f32>(at.xy, 0.0), vec3<f32>(0.0, 0.0, 1.0), at.xy, \
                 vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(0.0, 1.0, 0.0), pixel_ellipse_round(0.002))"
                    .into(),
            );
        }
        "FrequencyClamp" => return Some("FrequencyClamp(3.0, 1.0, 8.0)".into()),
        "PixelEllipse" => return Some("pixel_ellipse_round(0.002)".into()),
        _ => {}
    }
    uniforms.iter().find_map(|(uniform, of)| {
        let list = of.strip_prefix("array<").and_then(|rest| rest.split(',').next());
        if *of == name {
            Some((*uniform).to_owned())
        } else if list == Some(name) {
            Some(format!("{uniform}[0]"))
        } else {
            let named = |ty: &Type, text: &str| ty.name.as_deref() == Some(text);
            let (_, holder) = module.types.iter().find(|(_, ty)| named(ty, of))?;
            let TypeInner::Struct { ref members, .. } = holder.inner else { return None };
            let member = members.iter().find(|member| named(&module.types[member.ty], name))?;
            Some(format!("{uniform}.{}", member.name.as_deref()?))
        }
    })
}

/// A colour of what a function gives; of a structure that of its first member.
fn colour(module: &Module, ty: Handle<Type>, of: &str, signed: bool) -> Option<String> {
    let range = |text: String| if signed { format!("0.5 + 0.5 * {text}") } else { text };
    match module.types[ty].inner {
        TypeInner::Scalar(scalar) => Some(match scalar.kind {
            ScalarKind::Float => range(format!("vec3<f32>({of})")),
            ScalarKind::Sint | ScalarKind::Uint => format!("vec3<f32>(f32({of} & 255) / 255.0)"),
            ScalarKind::Bool => format!("vec3<f32>(select(0.0, 1.0, {of}))"),
            _ => return None,
        }),
        TypeInner::Vector { size, scalar } if scalar.kind == ScalarKind::Float => Some(match size as u8 {
            2 => range(format!("vec3<f32>({of}, 0.0)")),
            3 => range(of.to_owned()),
            _ => range(format!("{of}.xyz")),
        }),
        TypeInner::Vector { scalar, .. } if scalar.kind != ScalarKind::Bool => {
            Some(format!("vec3<f32>(f32({of}.x & 255) / 255.0)"))
        }
        TypeInner::Struct { ref members, .. } => {
            let first = members.first()?;
            colour(module, first.ty, &format!("{of}.{}", first.name.as_deref()?), signed)
        }
        _ => None,
    }
}

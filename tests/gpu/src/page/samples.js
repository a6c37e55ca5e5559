// Uses of a part in engines: text, made of what the part is bound to and of the call of one of its functions.

const short = name => name.split("/").pop();
const fileOf = part => `parts/${part.name}`;
const hasSamplers = part => part.bindings.some(b => b.kind === "sampler");
// Texels of tables: rows are filled up with zeros.
const indent = (text, by) => text.split("\n").map(line => (line ? " ".repeat(by) + line : line)).join("\n");
const lines = (...texts) => texts.flat().filter(text => text !== null && text !== undefined).join("\n");
const crate = rust => rust.split("::")[0];

// What a mip-mapped texture or a sampler takes is made by the host; files hold uniforms and tables.
const filled = part => part.bindings.filter(b => b.kind === "uniform" || b.kind === "table");
const made = part => part.bindings.filter(b => b.kind === "texture" || b.kind === "sampler");

const ENGINES = [
  {
    name: "wgpu",
    said: "Of wgpu 30; `cargo run --example heights` and `--example teapot` in tests/gpu are this, whole, and are run by the gates.",
    language: "rust",
    text: wgpu,
  },
  {
    name: "Bevy",
    said: "For Bevy 0.18. Not run.",
    language: "rust",
    text: bevy,
  },
  {
    name: "three.js",
    said: "For WebGL 2, three r187. Run in Chromium on a driver in software for 131 parts; there tempered glass was not ready in two minutes, and normal maps, bump-mapped and normal-mapped materials were not tried.",
    language: "js",
    text: three,
  },
  {
    name: "Godot",
    said: "For Godot 4, through RenderingDevice. Not run.",
    language: "gdscript",
    text: godot,
  },
  {
    name: "Unity",
    said: "For Unity 6, a pass of ShaderLab and a component. Not run: glslangValidator accepts the HLSL, Unity was not tried.",
    language: "hlsl",
    text: unity,
  },
  {
    name: "Metal",
    said: "For Metal 2.4 and later, in Swift. Not run: g++ accepts names and types, as C++; no compiler but Apple's reads MSL.",
    language: "swift",
    text: metal,
  },
];

function wgpu(part) {
  const bindings = part.bindings.map(b => {
    const at = `binding: ${b.binding}, resource`;
    if (b.kind === "uniform") return `wgpu::BindGroupEntry { ${at}: ${b.name}.as_entire_binding() },`;
    if (b.kind === "sampler") return `wgpu::BindGroupEntry { ${at}: wgpu::BindingResource::Sampler(&${b.name}) },`;
    return `wgpu::BindGroupEntry { ${at}: wgpu::BindingResource::TextureView(&${b.name}) },`;
  });
  const values = part.bindings.map(b => {
    if (b.kind === "uniform") return lines(
      `// ${b.fill}`,
      `let ${b.name} = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {`,
      `    label: None,`,
      `    contents: bytemuck::cast_slice(&${b.name}_words), // ${b.words} words`,
      `    usage: wgpu::BufferUsages::UNIFORM,`,
      `});`);
    if (b.kind === "table") return lines(
      `// ${b.fill}; rows filled up with zeros`,
      `let ${b.name} = device.create_texture_with_data(&queue, &wgpu::TextureDescriptor {`,
      `    label: None,`,
      `    size: wgpu::Extent3d { width: ${b.width}, height: ${b.height}, depth_or_array_layers: 1 },`,
      `    mip_level_count: 1,`,
      `    sample_count: 1,`,
      `    dimension: wgpu::TextureDimension::D2,`,
      `    format: wgpu::TextureFormat::${b.holds === "r32float" ? "R32Float" : "R32Uint"},`,
      `    usage: wgpu::TextureUsages::TEXTURE_BINDING,`,
      `    view_formats: &[],`,
      `}, wgpu::util::TextureDataOrder::LayerMajor, bytemuck::cast_slice(&${b.name}_words));`,
      `let ${b.name} = ${b.name}.create_view(&wgpu::TextureViewDescriptor::default());`);
    return `// \`${b.name}\`: ${b.fill}`;
  });
  const parts = part.rust.split("::");
  return [[null, lines(
    `use asperity_shaders::{Bindings, Part, compose, ${parts[0]}};`,
    part.bindings.length ? `use wgpu::util::DeviceExt;` : null,
    ``,
    `static PIXEL: Part = Part::new(`,
    `    "pixel",`,
    `    "fn pixel(at: vec3<f32>) -> vec3<f32> {`,
    `        let result = ${part.call};`,
    `        return ${part.colour};`,
    `    }`,
    `    @fragment`,
    `    fn fragment(@location(0) at: vec3<f32>) -> @location(0) vec4<f32> {`,
    `        return vec4<f32>(pixel(at), 1.0);`,
    `    }",`,
    `    &[&${part.rust}],`,
    `)${ownUniforms(part)};`,
    ``,
    `let wgsl = compose(&[&PIXEL], Bindings::Textures { group: 0 });`,
    `let source = wgpu::ShaderSource::Wgsl(wgsl.into());`,
    `let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });`,
    part.bindings.length ? `\n${values.join("\n")}` : null,
    part.bindings.length ? lines(
      ``,
      `// A layout of your own where entries share a group: the pipeline's leaves out what its entries do not read.`,
      `let group = device.create_bind_group(&wgpu::BindGroupDescriptor {`,
      `    label: None,`,
      `    layout: &pipeline.get_bind_group_layout(0),`,
      `    entries: &[`,
      indent(bindings.join("\n"), 8),
      `    ],`,
      `});`) : null)]];
}

// Uniforms of one's own, where a function takes a structure.
function ownUniforms(part) {
  const own = part.bindings.filter(b => part.own.includes(b.part) && b.part.startsWith("case/"));
  if (!own.length) return "";
  const rows = own.map(b => `    asperity_shaders::Binding::Uniform { name: "${b.name}", of: "${b.holds}" },`);
  return `\n.with_bindings(&[\n${rows.join("\n")}\n])`;
}

function bevy(part) {
  const path = part.name.replaceAll("/", "::");
  const fields = part.bindings.flatMap(b => {
    if (b.kind === "uniform") return [`#[uniform(${b.binding})]`, `${b.name}: [UVec4; ${Math.ceil(b.words / 4)}],`];
    if (b.kind === "sampler") return [];
    if (b.kind === "texture") {
      const sampler = part.bindings.find(s => s.kind === "sampler" && s.binding === b.binding + 1);
      return [`#[texture(${b.binding})]`, sampler ? `#[sampler(${sampler.binding})]` : null, `${b.name}: Handle<Image>,`];
    }
    const type = b.holds === "r32float" ? `sample_type = "float", filterable = false` : `sample_type = "u_int"`;
    return [`#[texture(${b.binding}, ${type})]`, `${b.name}: Handle<Image>,`];
  }).filter(Boolean);
  const tables = part.bindings.filter(b => b.kind === "table");
  // Types and further functions that the call names.
  const used = [...new Set(part.call.match(/[A-Za-z_]\w*(?=\()/g))]
    .filter(name => !/^(vec\d|normalize|u32|i32|f32|select)$/.test(name));
  const values = part.bindings.filter(b => b.kind === "uniform" && part.call.includes(b.name)).map(b => b.name);
  return [
    ["surface.wgsl in the assets", lines(
      `#import bevy_pbr::forward_io::VertexOutput`,
      `#import asperity::${path}::{${[...used, ...values].join(", ")}}`,
      ``,
      `@fragment`,
      `fn fragment(mesh: VertexOutput) -> @location(0) vec4<f32> {`,
      `    let at = vec3<f32>(mesh.uv, 0.5);`,
      `    let result = ${part.call};`,
      `    return vec4<f32>(${part.colour}, 1.0);`,
      `}`), "wgsl"],
    [`beside ${fileOf(part)}/bevy.wgsl`, lines(
      `use bevy::{`,
      `    asset::RenderAssetUsages,`,
      `    prelude::*,`,
      `    render::render_resource::{AsBindGroup, Extent3d, TextureDimension, TextureFormat},`,
      `    shader::{ShaderRef, load_shader_library},`,
      `};`,
      ``,
      `#[derive(Asset, TypePath, AsBindGroup, Clone)]`,
      fields.length ? `struct Surface {\n${indent(fields.join("\n"), 4)}\n}` : `struct Surface {}`,
      ``,
      `impl Material for Surface {`,
      `    fn fragment_shader() -> ShaderRef {`,
      `        "surface.wgsl".into()`,
      `    }`,
      `}`,
      ``,
      `pub struct SurfacePlugin;`,
      ``,
      `impl Plugin for SurfacePlugin {`,
      `    fn build(&self, app: &mut App) {`,
      `        load_shader_library!(app, "bevy.wgsl");`,
      `        app.add_plugins(MaterialPlugin::<Surface>::default());`,
      `    }`,
      `}`,
      tables.length ? lines(
        ``,
        `// A table as an image, of words whose rows are filled up with zeros.`,
        `fn table(words: &[u32], width: u32, format: TextureFormat) -> Image {`,
        `    let size = Extent3d { width, height: words.len() as u32 / width, depth_or_array_layers: 1 };`,
        `    let bytes = words.iter().flat_map(|word| word.to_le_bytes()).collect();`,
        `    Image::new(size, TextureDimension::D2, bytes, format, RenderAssetUsages::RENDER_WORLD)`,
        `}`,
        tables.map(b => `// ${b.name}: ${b.width} wide, ${b.holds === "r32float" ? "R32Float" : "R32Uint"}; ${b.fill}`)) : null,
      part.bindings.filter(b => b.kind === "uniform").map(b => `// ${b.name}: the words, four a UVec4; ${b.fill}`))],
  ];
}

function three(part) {
  const tables = filled(part).filter(b => b.kind === "table");
  const uniforms = filled(part).filter(b => b.kind === "uniform" && b.block);
  const variable = b => `_group_0_binding_${b.binding}_fs`;
  return [[null, lines(
    `import * as THREE from "three";`,
    ``,
    `const folder = "${fileOf(part)}/";`,
    `const source = await (await fetch(folder + "shader-es-300.frag")).text();`,
    filled(part).length ? `const words = async name => new Uint32Array(await (await fetch(folder + name + ".bin")).arrayBuffer());` : null,
    ``,
    tables.length ? lines(
      `// Texels are read one by one: rows are filled up with zeros, nothing is filtered.`,
      `function table(words, width, isFloat) {`,
      `  const texels = new Uint32Array(width * Math.ceil(words.length / width));`,
      `  texels.set(words);`,
      `  const data = isFloat ? new Float32Array(texels.buffer) : texels;`,
      `  const texture = isFloat`,
      `    ? new THREE.DataTexture(data, width, data.length / width, THREE.RedFormat, THREE.FloatType)`,
      `    : new THREE.DataTexture(data, width, data.length / width, THREE.RedIntegerFormat, THREE.UnsignedIntType);`,
      `  texture.internalFormat = isFloat ? "R32F" : "R32UI";`,
      `  texture.needsUpdate = true;`,
      `  return texture;`,
      `}`,
      ``) : null,
    uniforms.length ? lines(
      `// A block of words in the layout that WGSL and std140 share; "uint" keeps every bit.`,
      `function block(name, words) {`,
      `  const values = new THREE.Uniform(words);`,
      `  values.type = "uint";`,
      `  return new THREE.UniformsGroup().setName(name).add(values);`,
      `}`,
      ``) : null,
    `const material = new THREE.RawShaderMaterial({`,
    `  glslVersion: THREE.GLSL3,`,
    `  vertexShader: \``,
    `    in vec3 position;`,
    `    in vec2 uv;`,
    `    uniform mat4 modelViewMatrix, projectionMatrix;`,
    `    out vec3 _vs2fs_location0;`,
    `    void main() {`,
    `      _vs2fs_location0 = vec3(uv, 0.5);`,
    `      gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);`,
    `    }\`,`,
    `  // The version is three's own line.`,
    `  fragmentShader: source.replace(/^#version.*\\n/, ""),`,
    tables.length || made(part).length ? `  uniforms: {` : null,
    tables.map(b => `    ${variable(b)}: { value: table(await words("${b.name}"), ${b.width}, ${b.holds === "r32float"}) }, // ${b.name}`),
    made(part).filter(b => b.kind === "texture").map(b => `    ${variable(b)}: { value: ${b.name} }, // ${b.fill}`),
    tables.length || made(part).length ? `  },` : null,
    `});`,
    uniforms.length ? lines(
      `material.uniformsGroups = [`,
      uniforms.map(b => `  block("${b.block}", await words("${b.name}")), // ${b.name}`),
      `];`) : null,
    `const mesh = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material);`)]];
}

function godot(part) {
  const bind = (b, kind, id) => lines(
    `uniforms.append(bound(RenderingDevice.UNIFORM_TYPE_${kind}, ${b.binding}, ${id})) # ${b.name}`);
  return [[null, lines(
    `extends Node`,
    ``,
    `const FOLDER := "res://asperity/${fileOf(part)}/"`,
    `const SIZE := 512`,
    `var rd := RenderingServer.create_local_rendering_device()`,
    ``,
    `func bytes(file: String) -> PackedByteArray:`,
    `\treturn FileAccess.get_file_as_bytes(FOLDER + file)`,
    ``,
    `func bound(type: RenderingDevice.UniformType, binding: int, id: RID) -> RDUniform:`,
    `\tvar uniform := RDUniform.new()`,
    `\tuniform.uniform_type = type`,
    `\tuniform.binding = binding`,
    `\tuniform.add_id(id)`,
    `\treturn uniform`,
    ``,
    `func texture(width: int, height: int, format: int, usage: int, data: PackedByteArray) -> RID:`,
    `\tvar of := RDTextureFormat.new()`,
    `\tof.width = width`,
    `\tof.height = height`,
    `\tof.format = format`,
    `\tof.usage_bits = usage`,
    `\tvar layers: Array[PackedByteArray] = []`,
    `\tif not data.is_empty():`,
    `\t\tdata.resize(width * height * 4) # rows are filled up with zeros`,
    `\t\tlayers.append(data)`,
    `\treturn rd.texture_create(of, RDTextureView.new(), layers)`,
    ``,
    `func _ready() -> void:`,
    `\tvar spirv := RDShaderSPIRV.new()`,
    `\tspirv.bytecode_compute = bytes("compute.spv")`,
    `\tvar shader := rd.shader_create_from_spirv(spirv)`,
    `\tvar uniforms: Array[RDUniform] = []`,
    part.bindings.map(b => {
      if (b.kind === "uniform") return lines(
        `\tvar ${b.name} := bytes("${b.name}.bin")`,
        `\t${bind(b, "UNIFORM_BUFFER", `rd.uniform_buffer_create(${b.name}.size(), ${b.name})`)}`);
      if (b.kind === "table") return `\t${bind(b, "TEXTURE", lines(
        `texture(${b.width}, ${b.height},`,
        `\t\tRenderingDevice.DATA_FORMAT_R32_${b.holds === "r32float" ? "SFLOAT" : "UINT"}, RenderingDevice.TEXTURE_USAGE_SAMPLING_BIT, bytes("${b.name}.bin"))`))}`;
      if (b.kind === "sampler") return `\t${bind(b, "SAMPLER", "linear")}: ${b.fill}`;
      return `\t${bind(b, "TEXTURE", b.name)}: ${b.fill}`;
    }),
    `\tvar image := texture(SIZE, SIZE, RenderingDevice.DATA_FORMAT_R32G32B32A32_SFLOAT,`,
    `\t\tRenderingDevice.TEXTURE_USAGE_STORAGE_BIT | RenderingDevice.TEXTURE_USAGE_CAN_COPY_FROM_BIT, PackedByteArray())`,
    `\tvar target := rd.uniform_set_create([bound(RenderingDevice.UNIFORM_TYPE_IMAGE, 0, image)], shader, 1)`,
    `\tvar pipeline := rd.compute_pipeline_create(shader)`,
    `\tvar list := rd.compute_list_begin()`,
    `\trd.compute_list_bind_compute_pipeline(list, pipeline)`,
    part.bindings.length ? `\trd.compute_list_bind_uniform_set(list, rd.uniform_set_create(uniforms, shader, 0), 0)` : null,
    `\trd.compute_list_bind_uniform_set(list, target, 1)`,
    `\trd.compute_list_dispatch(list, SIZE / 8, SIZE / 8, 1)`,
    `\trd.compute_list_end()`,
    `\trd.submit()`,
    `\trd.sync()`,
    `\tvar picture := Image.create_from_data(SIZE, SIZE, false, Image.FORMAT_RGBAF, rd.texture_get_data(image, 0))`,
    `\tpicture.convert(Image.FORMAT_RGB8)`,
    `\tpicture.save_png("user://${short(part.name)}.png")`)]];
}

function unity(part) {
  if (hasSamplers(part)) return [[null, lines(
    `// naga keeps samplers in HLSL in a heap of Direct3D 12, which Unity does not bind.`,
    `// Declare the texture and its sampler in Unity's way, and call the part's functions with them.`), "hlsl"]];
  const shader = `Asperity/${part.name}`;
  return [
    [`${short(part.name)}.shader`, lines(
      `Shader "${shader}"`,
      `{`,
      `    SubShader`,
      `    {`,
      `        Pass`,
      `        {`,
      `            HLSLPROGRAM`,
      `            #pragma target 5.0`,
      `            #pragma use_dxc`,
      `            #pragma vertex corner`,
      `            #pragma fragment show_part`,
      `            #include "UnityCG.cginc"`,
      `            // ${part.function || "its functions"} and the entry show_part, whose input has the semantic LOC0.`,
      `            #include "${fileOf(part)}/shader.hlsl"`,
      ``,
      `            struct Corner`,
      `            {`,
      `                float3 at : LOC0;`,
      `                float4 position : SV_Position;`,
      `            };`,
      ``,
      `            Corner corner(float4 vertex : POSITION, float2 uv : TEXCOORD0)`,
      `            {`,
      `                Corner result;`,
      `                result.at = float3(uv, 0.5);`,
      `                result.position = UnityObjectToClipPos(vertex);`,
      `                return result;`,
      `            }`,
      `            ENDHLSL`,
      `        }`,
      `    }`,
      `}`), "hlsl"],
    [`Surface.cs`, lines(
      `using System;`,
      `using System.IO;`,
      `using UnityEngine;`,
      `using UnityEngine.Experimental.Rendering;`,
      ``,
      `public class Surface : MonoBehaviour`,
      `{`,
      part.bindings.some(b => b.kind === "uniform") ? `    readonly System.Collections.Generic.List<GraphicsBuffer> buffers = new();\n` : null,
      `    static byte[] Bytes(string name) =>`,
      `        File.ReadAllBytes(Path.Combine(Application.streamingAssetsPath, "${fileOf(part)}", name + ".bin"));`,
      ``,
      `    void Start()`,
      `    {`,
      `        var material = new Material(Shader.Find("${shader}"));`,
      part.bindings.map(b => b.kind === "uniform"
        ? `        Block(material, "${b.name}");`
        : `        Table(material, "${b.name}", ${b.width}, ${b.height}, GraphicsFormat.R32_${b.holds === "r32float" ? "SFloat" : "UInt"});`),
      `        GetComponent<Renderer>().material = material;`,
      `    }`,
      part.bindings.some(b => b.kind === "table") ? lines(
        ``,
        `    static void Table(Material material, string name, int width, int height, GraphicsFormat format)`,
        `    {`,
        `        var bytes = Bytes(name);`,
        `        Array.Resize(ref bytes, 4 * width * height); // rows are filled up with zeros`,
        `        var texture = new Texture2D(width, height, format, TextureCreationFlags.None) { filterMode = FilterMode.Point };`,
        `        texture.LoadRawTextureData(bytes);`,
        `        texture.Apply(false, true);`,
        `        material.SetTexture(name + "_table", texture);`,
        `    }`) : null,
      part.bindings.some(b => b.kind === "uniform") ? lines(
        ``,
        `    void Block(Material material, string name)`,
        `    {`,
        `        var bytes = Bytes(name);`,
        `        var buffer = new GraphicsBuffer(GraphicsBuffer.Target.Constant, bytes.Length / 16, 16);`,
        `        buffer.SetData(bytes);`,
        `        material.SetConstantBuffer(name, buffer, 0, bytes.Length);`,
        `        buffers.Add(buffer);`,
        `    }`,
        ``,
        `    void OnDestroy() => buffers.ForEach(buffer => buffer.Dispose());`) : null,
      `}`), "csharp"],
  ];
}

function metal(part) {
  const bind = part.bindings.map(b => {
    if (b.kind === "uniform") return `encoder.setFragmentBuffer(try block("${b.name}"), offset: 0, index: ${b.metal})`;
    if (b.kind === "table") return `encoder.setFragmentTexture(try table("${b.name}", width: ${b.width}, height: ${b.height}, format: .r32${b.holds === "r32float" ? "Float" : "Uint"}), index: ${b.metal})`;
    if (b.kind === "sampler") return `encoder.setFragmentSamplerState(${b.name}, index: ${b.metal}) // ${b.fill}`;
    return `encoder.setFragmentTexture(${b.name}, index: ${b.metal}) // ${b.fill}`;
  });
  return [[null, lines(
    `import Foundation`,
    `import Metal`,
    ``,
    `let folder = URL(fileURLWithPath: "${fileOf(part)}")`,
    `let device = MTLCreateSystemDefaultDevice()!`,
    `let options = MTLCompileOptions()`,
    `options.fastMathEnabled = false // sums and products as they are written`,
    `let source = try String(contentsOf: folder.appendingPathComponent("shader.metal"), encoding: .utf8)`,
    `let parts = try device.makeLibrary(source: source, options: options)`,
    `// A triangle over the whole target, whose output \`loc0\` is what the entry takes.`,
    `let corners = try device.makeLibrary(source: """`,
    `    #include <metal_stdlib>`,
    `    struct Corner { float4 position [[position]]; float3 at [[user(loc0)]]; };`,
    `    vertex Corner corner(uint i [[vertex_id]]) {`,
    `        float2 uv = float2((i << 1) & 2, i & 2);`,
    `        return { float4(uv * 2.0 - 1.0, 0.0, 1.0), float3(uv, 0.5) };`,
    `    }`,
    `    """, options: nil)`,
    ``,
    `let descriptor = MTLRenderPipelineDescriptor()`,
    `descriptor.vertexFunction = corners.makeFunction(name: "corner")`,
    `descriptor.fragmentFunction = parts.makeFunction(name: "show_part")`,
    `descriptor.colorAttachments[0].pixelFormat = .rgba8Unorm`,
    `let pipeline = try device.makeRenderPipelineState(descriptor: descriptor)`,
    part.bindings.length ? lines(
      ``,
      `func words(_ name: String) throws -> Data {`,
      `    try Data(contentsOf: folder.appendingPathComponent(name + ".bin"))`,
      `}`) : null,
    part.bindings.some(b => b.kind === "uniform") ? lines(
      ``,
      `func block(_ name: String) throws -> MTLBuffer {`,
      `    try words(name).withUnsafeBytes { device.makeBuffer(bytes: $0.baseAddress!, length: $0.count)! }`,
      `}`) : null,
    part.bindings.some(b => b.kind === "table") ? lines(
      ``,
      `func table(_ name: String, width: Int, height: Int, format: MTLPixelFormat) throws -> MTLTexture {`,
      `    var data = try words(name)`,
      `    data.append(Data(count: 4 * width * height - data.count)) // rows are filled up with zeros`,
      `    let of = MTLTextureDescriptor.texture2DDescriptor(pixelFormat: format, width: width, height: height, mipmapped: false)`,
      `    let texture = device.makeTexture(descriptor: of)!`,
      `    data.withUnsafeBytes {`,
      `        texture.replace(region: MTLRegionMake2D(0, 0, width, height), mipmapLevel: 0,`,
      `                        withBytes: $0.baseAddress!, bytesPerRow: 4 * width)`,
      `    }`,
      `    return texture`,
      `}`) : null,
    ``,
    `func draw(_ encoder: MTLRenderCommandEncoder) throws {`,
    `    encoder.setRenderPipelineState(pipeline)`,
    bind.map(text => `    ${text}`),
    `    encoder.drawPrimitives(type: .triangle, vertexStart: 0, vertexCount: 3)`,
    `}`)]];
}

//! Uniforms, storage buffers and textures.

use asperity_interpreter::Value;

use crate::interpreter;

#[test]
fn uniforms_have_wgsl_padding() {
    let wgsl = "
        struct Light { direction: vec3<f32>, power: f32, colour: vec3<f32> }
        struct Scene { count: u32, lights: array<Light, 2>, turn: mat3x3<f32>, flat: mat2x2<f32>, last: f32 }
        @group(0) @binding(0) var<uniform> scene: Scene;
        fn light(i: u32) -> Light { return scene.lights[i]; }
        fn whole() -> Scene { return scene; }
        fn power(i: u32) -> f32 { return scene.lights[i].power; }
        fn row() -> vec2<f32> { return scene.flat[1]; }
        fn entry(i: u32, j: u32) -> f32 { return scene.turn[i][j]; }";
    let mut shader = interpreter(wgsl);
    // 16 bytes of count, twice 32 of lights, 48 and 16 of matrices, and 16 with the last.
    let words: Vec<u32> = (0..40).collect();
    shader.uniform("scene", &words).unwrap();
    let call = |name: &str, arguments: &[Value]| shader.call(name, arguments).unwrap();
    assert_eq!(call("light", &[1_u32.into()]), [12_u32, 13, 14, 15, 16, 17, 18].into());
    assert_eq!(call("power", &[0_u32.into()]), 7_u32.into());
    assert_eq!(call("row", &[]), [34_u32, 35].into());
    assert_eq!(call("entry", &[2_u32.into(), 1_u32.into()]), 29_u32.into());
    let whole = [
        0, 4, 5, 6, 7, 8, 9, 10, 12, 13, 14, 15, 16, 17, 18, 20, 21, 22, 24, 25, 26, 28, 29, 30, 32, 33, 34,
        35, 36,
    ];
    assert_eq!(call("whole", &[]).words(), whole);
    let wrong = shader.uniform("scene", &words[1..]).unwrap_err();
    assert_eq!(wrong, "`scene` has 40 words, got 39");
}

#[test]
fn storage_buffer_length_follows_its_words() {
    let wgsl = "
        @group(0) @binding(0) var<storage, read> table: array<f32>;
        @group(0) @binding(1) var<storage, read> points: array<vec3<f32>>;
        @group(0) @binding(2) var<storage, read> rows: array<vec4<u32>, 2>;
        fn at(i: u32) -> f32 { return table[i]; }
        fn point(i: u32) -> vec3<f32> { return points[i]; }
        fn row(i: u32) -> vec4<u32> { return rows[i]; }
        fn word(i: u32, j: u32) -> u32 { return rows[i][j]; }
        fn lengths() -> vec2<u32> { return vec2<u32>(arrayLength(&table), arrayLength(&points)); }";
    let mut shader = interpreter(wgsl);
    shader.storage("table", (0..5).map(|i| (i as f32).to_bits()).collect()).unwrap();
    shader.storage("points", (0..12).collect()).unwrap();
    shader.storage("rows", (10..18).collect()).unwrap();
    assert_eq!(shader.call("at", &[4_u32.into()]).unwrap(), 4.0.into());
    assert_eq!(shader.call("point", &[2_u32.into()]).unwrap(), [8_u32, 9, 10].into());
    assert_eq!(shader.call("row", &[1_u32.into()]).unwrap(), [14_u32, 15, 16, 17].into());
    assert_eq!(shader.call("word", &[1_u32.into(), 2_u32.into()]).unwrap(), 16_u32.into());
    assert_eq!(shader.call("lengths", &[]).unwrap(), [5_u32, 3].into());
    let outside = shader.call("at", &[5_u32.into()]).unwrap_err();
    assert_eq!(outside, "word 5 is out of bounds of `table`, in `at`");
    let outside = shader.call("row", &[2_u32.into()]).unwrap_err();
    assert_eq!(outside, "index 2 is outside 2 elements, in `row`");
    let wrong = shader.storage("points", vec![0; 9]).unwrap_err();
    assert_eq!(wrong, "`points` has elements of 4 words, got 9");
}

#[test]
fn textures_are_read_bit_exactly() {
    let wgsl = "
        @group(0) @binding(0) var floats: texture_2d<f32>;
        @group(0) @binding(1) var words: texture_2d<u32>;
        fn float(x: i32, y: i32) -> vec4<f32> { return textureLoad(floats, vec2<i32>(x, y), 0); }
        fn word(x: u32, y: u32) -> vec4<u32> { return textureLoad(words, vec2<u32>(x, y), 0); }
        fn size() -> vec2<u32> { return textureDimensions(floats); }
        fn entry(table: texture_2d<u32>, at: i32) -> u32 { return textureLoad(table, vec2<i32>(at, 1), 0).x; }
        fn handed(at: i32) -> u32 { return entry(words, at); }";
    let mut shader = interpreter(wgsl);
    // A denormal and a NaN with a payload are preserved.
    shader.texture("floats", 3, vec![1, 0x7fc0_1234, 2, 3, 4, 5]).unwrap();
    let unbound = shader.call("handed", &[0.into()]).unwrap_err();
    assert_eq!(unbound, "no resource for `words`, in `entry`, in `handed`");
    shader.texture("words", 2, vec![7, 8, 9, 10]).unwrap();
    let one = 1.0_f32.to_bits();
    assert_eq!(shader.call("float", &[1.into(), 0.into()]).unwrap(), [0x7fc0_1234, 0, 0, one].into());
    assert_eq!(shader.call("float", &[2.into(), 1.into()]).unwrap(), [5, 0, 0, one].into());
    assert_eq!(shader.call("word", &[1_u32.into(), 1_u32.into()]).unwrap(), [10_u32, 0, 0, 1].into());
    assert_eq!(shader.call("size", &[]).unwrap(), [3_u32, 2].into());
    assert_eq!(shader.call("handed", &[1.into()]).unwrap(), 10_u32.into());
    let outside = shader.call("float", &[(-1).into(), 0.into()]).unwrap_err();
    assert_eq!(outside, "texel (-1, 0) of level 0 is outside the 3 × 2 of `floats`, in `float`");
    assert!(shader.texture("words", 3, vec![0; 4]).is_err());
    assert!(shader.texture("words", 0, vec![]).is_err());
}

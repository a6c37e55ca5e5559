//! The shader composer: any parts, including circular dependencies, are joined without duplicates.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use asperity_wgsl::{
    Binding, Bindings, Element, Imports, Part, compose, fif, module, ndf, noise, ordered, shading,
};

use crate::numbers::Numbers;

/// Custom parts with circular dependencies.
static FIRST: Part = Part::new("first", "fn first() {}\n", &[&SECOND, &noise::WHITE]);
static SECOND: Part = Part::new("second", "fn second() {}\n", &[&THIRD, &SECOND]);
static THIRD: Part = Part::new("first", "const THIRD = 1;\n", &[&FIRST]);

/// Tables of any width.
static TABLES: Part = Part::new("tables", "fn tables() {}\n", &[]).with_bindings(&[
    Binding::Table { name: "none", element: Element::Word, width: 0 },
    Binding::Table { name: "odd", element: Element::Float, width: 3 },
    Binding::Table { name: "most", element: Element::Float, width: u32::MAX },
]);

fn parts() -> &'static [&'static Part] {
    static PARTS: OnceLock<Vec<&'static Part>> = OnceLock::new();
    PARTS.get_or_init(|| {
        vec![
            &FIRST,
            &SECOND,
            &THIRD,
            &TABLES,
            &noise::WHITE,
            &noise::GAUSSIAN,
            &noise::PERLIN,
            &noise::SIMPLEX,
            &ndf::GGX,
            &ndf::BECKMANN,
            &shading::texture::STAR_WALLPAPER,
            &shading::material::METALLIC_PAINT,
            &shading::material::BRICK_WALL,
            &fif::TABLE,
        ]
    })
}

pub(crate) fn attack(numbers: &mut Numbers<'_>) {
    let group = numbers.word();
    let bindings = numbers.pick(&[Bindings::Textures { group }, Bindings::Buffers { group }]);
    let imports = numbers.pick(&[Imports::NagaOil, Imports::Wesl]);
    let chosen: Vec<&'static Part> = numbers.list(3, |numbers| numbers.pick(parts()));
    let all = ordered(&chosen);
    let names: BTreeSet<_> = all.iter().map(|part| part.name()).collect();
    assert_eq!(names.len(), all.len(), "a part is there twice");
    for part in &chosen {
        assert!(names.contains(part.name()), "{} is missing", part.name());
    }
    if let Some(part) = chosen.first().filter(|_| numbers.byte() < 16) {
        assert!(module(part, imports, bindings).ends_with(part.source()));
    }
    let wgsl = compose(&chosen, bindings);
    let length: usize = all.iter().map(|part| part.source().len()).sum();
    assert!(wgsl.len() >= length);
}

//! Colors and strokes of a plot, which are the colors of its page.

use plotters::style::{Color, RGBAColor, RGBColor, ShapeStyle};

use crate::plot::place::units;
use asperity::html::{self, escape};

/// A color of the page.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Ink {
    /// The page's text.
    Text,
    /// Secondary text and axes.
    Muted,
    /// Hairlines.
    Rule,
    /// The background of the image.
    Card,
    /// Data, 1 to 4, repeated for higher numbers.
    Series(u8),
}

impl From<u8> for Ink {
    fn from(series: u8) -> Self {
        Self::Series(series)
    }
}

/// Color, width and dash of a line.
#[derive(Clone, Copy)]
pub(crate) struct Stroke {
    pub(crate) ink: Ink,
    /// In CSS pixels.
    pub(crate) width: f64,
    pub(crate) dashed: bool,
}

impl Stroke {
    /// A solid line of the usual width.
    pub(crate) fn solid(ink: impl Into<Ink>) -> Self {
        Self { ink: ink.into(), width: 1.6, dashed: false }
    }

    /// A dashed line of the usual width.
    pub(crate) fn dashed(ink: impl Into<Ink>) -> Self {
        Self { dashed: true, ..Self::solid(ink) }
    }

    /// Changes the width.
    pub(crate) fn wide(self, width: f64) -> Self {
        Self { width, ..self }
    }

    pub(super) fn style(self) -> ShapeStyle {
        color(self.ink, self.dashed).stroke_width(units(self.width))
    }
}

/// The backend writes fixed colors. Each ink, dashed or not, gets a unique placeholder, replaced in
/// [`dress`].
pub(super) fn color(ink: Ink, dashed: bool) -> RGBAColor {
    let index = match ink {
        Ink::Text => 0,
        Ink::Muted => 1,
        Ink::Rule => 2,
        Ink::Card => 3,
        Ink::Series(n) => 4 + n.wrapping_sub(1) % 4,
    };
    RGBColor(0xA5, dashed.into(), index).to_rgba()
}

/// Replaces the placeholders by the page's colors, with dark variants in the image's own style. The
/// image looks the same in the page, alone, and where styles are ignored.
pub(super) fn dress(svg: &str, title: &str, size: [f64; 2]) -> String {
    const NAMES: [&str; 8] = ["ink", "muted", "rule", "card", "series-1", "series-2", "series-3", "series-4"];
    const DASHES: [&str; 2] = ["", " stroke-dasharray=\"55 45\""];
    let mut text = svg.find('\n').map_or("", |end| &svg[end..]).to_owned();
    let mut dark = String::new();
    for (index, name) in NAMES.iter().enumerate() {
        let [day, night] = html::color(name);
        for (dash, pattern) in DASHES.iter().enumerate() {
            text = text.replace(&format!("\"#A5{dash:02X}{index:02X}\""), &format!("\"{day}\"{pattern}"));
        }
        dark += &format!("  [fill=\"{day}\"] {{ fill: {night} }} [stroke=\"{day}\"] {{ stroke: {night} }}\n");
    }
    let ([width, height], [card, _]) = (size, html::color("card"));
    let (title, [across, down]) = (escape(title), size.map(units));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {across} {down}\" width=\"{width}\" height=\"{height}\" \
         role=\"img\" stroke-linejoin=\"round\" stroke-linecap=\"round\" style=\"color-scheme: light dark\">\n\
         <title>{title}</title>\n<style>@media (prefers-color-scheme: dark) {{\n{dark}}}</style>\n\
         <rect width=\"{across}\" height=\"{down}\" fill=\"{card}\"/>{}",
        text.replace("opacity=\"1\" ", "")
            .replace("font-family=\"system-ui\"", "font-family=\"system-ui, sans-serif\"")
    )
}

//! What a run did.

use crate::failure::Result;

/// What was done to a file.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    /// The materials with a normal map.
    pub materials: Vec<FilteredMaterial>,
    /// Files written, the model first.
    pub files: Vec<String>,
}

/// What was done to a material.
#[derive(Clone, Debug)]
pub struct FilteredMaterial {
    /// Index in the file.
    pub index: usize,
    /// Name in the file; may be empty.
    pub name: String,
    /// The levels of its new roughness, or why it is left as it is.
    pub outcome: Result<Vec<FilteredLevel>, String>,
    /// Root mean square of the highlight's error over its root mean square, before and after, with
    /// `--report`.
    pub error: Option<[f64; 2]>,
}

/// A mip level of a filtered roughness map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilteredLevel {
    pub width: usize,
    pub height: usize,
    /// Mean roughness of plain mip levels.
    pub before: f64,
    /// Mean roughness of the new texture.
    pub after: f64,
}

impl Summary {
    /// Returns the summary for a terminal.
    pub fn lines(&self, report: bool) -> Vec<String> {
        let mut lines = Vec::new();
        for material in &self.materials {
            let name = if material.name.is_empty() { String::new() } else { format!(" `{}`", material.name) };
            let of = format!("material {}{name}", material.index);
            let levels = match &material.outcome {
                Err(why) => {
                    lines.push(format!("{of}: left as it is: {why}"));
                    continue;
                }
                Ok(levels) => levels,
            };
            let [width, height] = levels.first().map_or([0; 2], |level| [level.width, level.height]);
            lines.push(format!("{of}: {} levels, {width} × {height}", levels.len()));
            for level in levels.iter().filter(|_| report) {
                let FilteredLevel { width, height, before, after } = level;
                lines.push(format!("  {width:>5} × {height:<5} mean roughness {before:.3} -> {after:.3}"));
            }
            if let Some([before, after]) = material.error {
                lines.push(format!("  error of the highlight {before:.3} -> {after:.3}"));
            }
        }
        if self.materials.is_empty() {
            lines.push("no material has a normal map: the file is copied unchanged".into());
        }
        lines.extend(self.files.first().map(|file| format!("model written to {file}")));
        lines
    }
}

//! The files that a run writes, all at its end.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::cli::filter::Filter;
use crate::failure::Result;
use crate::output::Output;

/// Files to write.
pub(super) struct Files {
    folder: PathBuf,
    /// Name of the model.
    pub(super) model: String,
    /// Whether the model's folder is another than the input's.
    pub(super) moved: bool,
    png: Option<PathBuf>,
    /// Names in the model's folder.
    files: Vec<(String, Vec<u8>)>,
    levels: Vec<(String, Vec<u8>)>,
    list: Vec<Value>,
}

impl Files {
    /// Checks the names.
    pub(super) fn new(wanted: &Filter) -> Result<Self> {
        let (from, to) = (wanted.model.as_path(), wanted.out.as_path());
        let [before, after] = [from, to].map(extension);
        if !["glb", "gltf"].contains(&&*before) {
            let name = from.display();
            return Err(format!("model `{name}`: unsupported file extension (expected .glb or .gltf)").into());
        }
        if before != after {
            let name = to.display();
            return Err(format!("`--out {name}` must have the extension of the model (.{before})").into());
        }
        let name = to.file_name().and_then(|name| name.to_str());
        let name = name.ok_or_else(|| format!("`--out {}` is not a file name", to.display()))?;
        if to.is_dir() {
            return Err(format!("`{}` is a directory", to.display()).into());
        }
        let folder = |path: &Path| path.parent().unwrap_or(Path::new("")).to_owned();
        let absolute = |path: &Path| {
            let folder = folder(path);
            let folder = if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder };
            folder.canonicalize().ok()
        };
        Ok(Self {
            folder: folder(to),
            model: name.to_owned(),
            moved: absolute(from) != absolute(to),
            png: wanted.png.clone(),
            files: Vec::new(),
            levels: Vec::new(),
            list: Vec::new(),
        })
    }

    /// Adds a file next to the model.
    pub(super) fn add(&mut self, name: String, bytes: Vec<u8>) {
        self.files.push((name, bytes));
    }

    /// Adds the levels of a material's texture, as PNG files of `--png`.
    pub(super) fn add_levels(&mut self, material: usize, kind: &str, factor: f32, levels: Vec<Vec<u8>>) {
        let name = |level| format!("material{material}_{kind}_{level}.png");
        let names: Vec<_> = (0..levels.len()).map(name).collect();
        let entry = json!({ "material": material, "texture": kind, "factor": factor, "levels": names });
        self.list.push(entry);
        self.levels.extend(names.into_iter().zip(levels));
    }

    /// Writes all files, and the model last.
    pub(super) fn write(self) -> Result<Vec<String>> {
        let mut written = Vec::new();
        if let Some(png) = self.png {
            let output = Output::new(png)?;
            output.write("levels.json", serde_json::to_string_pretty(&self.list)?.as_bytes())?;
            for (name, bytes) in &self.levels {
                output.write(name, bytes)?;
                written.push(output.place(name));
            }
        }
        let output = Output::new(self.folder)?;
        for (name, bytes) in &self.files {
            if let Some((folder, name)) = name.rsplit_once('/') {
                output.inside(folder)?.write(name, bytes)?;
            } else {
                output.write(name, bytes)?;
            }
            written.push(output.place(name));
        }
        written.reverse();
        Ok(written)
    }
}

fn extension(path: &Path) -> String {
    path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase()).unwrap_or_default()
}

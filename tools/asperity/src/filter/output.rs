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

    /// Returns an error if nothing can be written, before all work.
    pub(super) fn check(&self) -> Result<()> {
        Output::new(&self.folder)?;
        Ok(())
    }

    /// Adds a file next to the model.
    pub(super) fn add(&mut self, name: String, bytes: Vec<u8>) {
        self.files.push((name, bytes));
    }

    /// Adds a copy of a file of the model, which must not replace another file.
    pub(super) fn add_copy(&mut self, name: String, bytes: Vec<u8>) -> Result<()> {
        if !self.is_free(&name, &bytes) {
            let path = self.folder.join(name);
            return Err(format!("`{}` exists with other contents", path.display()).into());
        }
        self.add(name, bytes);
        Ok(())
    }

    /// Adds a new texture under the first name that is not taken, and returns its name.
    pub(super) fn add_texture(&mut self, extension: &str, bytes: Vec<u8>) -> String {
        let stem = self.model.rsplit_once('.').map_or(&*self.model, |(stem, _)| stem).to_owned();
        let names = (0_u32..).map(|k| format!("{stem}_roughness_{k}.{extension}"));
        let taken = |name: &String| self.files.iter().any(|(other, _)| other == name);
        let free = |name: &String| !taken(name) && self.is_free(name, &bytes);
        let name = names.into_iter().find(free).unwrap_or_default();
        self.add(name.clone(), bytes);
        name
    }

    /// Whether no file has the name, or one with the same bytes.
    fn is_free(&self, name: &str, bytes: &[u8]) -> bool {
        let path = self.folder.join(name);
        match path.try_exists() {
            Ok(true) => std::fs::read(path).is_ok_and(|there| there == bytes),
            _ => true,
        }
    }

    /// Adds the levels of a material's texture, as PNG files of `--png`.
    pub(super) fn add_levels(&mut self, material: usize, kind: &str, factor: f32, levels: Vec<Vec<u8>>) {
        let name = |level| format!("material{material}_{kind}_{level}.png");
        let names: Vec<_> = (0..levels.len()).map(name).collect();
        let entry = json!({ "material": material, "texture": kind, "factor": factor, "levels": names });
        self.list.push(entry);
        self.levels.extend(names.into_iter().zip(levels));
    }

    /// Writes all files, and the model last. After an error, no new file is left.
    pub(super) fn write(mut self) -> Result<Vec<String>> {
        let mut all = Vec::new();
        if let Some(png) = self.png.take() {
            let list = serde_json::to_string_pretty(&self.list)?.into_bytes();
            // A folder with a list has the levels of an earlier run.
            if !png.join("levels.json").exists()
                && let Some((name, _)) = self.levels.iter().find(|(name, _)| png.join(name).exists())
            {
                return Err(format!("`{}` exists", png.join(name).display()).into());
            }
            let levels = std::mem::take(&mut self.levels).into_iter();
            all.extend(levels.chain([("levels.json".into(), list)]).map(|file| (png.clone(), file)));
        }
        let folder = self.folder;
        all.extend(self.files.into_iter().map(|file| (folder.clone(), file)));
        let mut written: Vec<String> = Vec::new();
        let mut new = Vec::new();
        for (folder, (name, bytes)) in all {
            let path = folder.join(&name);
            let is_new = !path.exists();
            let (folder, name) = match name.rsplit_once('/') {
                Some((inner, name)) => (folder.join(inner), name),
                None => (folder, &*name),
            };
            let place = Output::new(folder).and_then(|output| {
                output.write(name, &bytes)?;
                Ok(output.place(name))
            });
            match place {
                Ok(place) => written.push(place),
                Err(error) => {
                    new.iter().for_each(|path| drop(std::fs::remove_file(path)));
                    return Err(error.into());
                }
            }
            if is_new {
                new.push(path);
            }
        }
        written.reverse();
        Ok(written)
    }
}

fn extension(path: &Path) -> String {
    path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase()).unwrap_or_default()
}

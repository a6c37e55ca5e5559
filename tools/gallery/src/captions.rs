//! Texts of the gallery, read from `captions.md`: pages, sections, titles, sources and captions.

use std::{collections::BTreeMap, sync::LazyLock};

use asperity::failure::Result;

/// A page of the gallery.
pub(crate) struct Page {
    /// The file next to the images.
    pub(crate) file: &'static str,
    pub(crate) title: &'static str,
    /// Link text on the other pages.
    pub(crate) name: &'static str,
    pub(crate) about: String,
}

/// The texts of one figure.
pub(crate) struct Caption {
    /// The file of its page.
    pub(crate) page: &'static str,
    /// The heading above it.
    pub(crate) section: &'static str,
    pub(crate) title: &'static str,
    /// The figure of the source that it reproduces, or `Asperity`.
    pub(crate) source: &'static str,
    /// Plain-text description of two to four sentences.
    pub(crate) text: String,
}

/// All texts.
pub(crate) struct Captions {
    pub(crate) pages: Vec<Page>,
    pub(crate) figures: BTreeMap<&'static str, Caption>,
}

/// The texts of the gallery.
pub(crate) static CAPTIONS: LazyLock<Captions> =
    LazyLock::new(|| Captions::read(include_str!("captions.md")));

impl Captions {
    /// Returns the texts of a figure.
    pub(crate) fn of(&self, figure: &str) -> Result<&Caption> {
        self.figures.get(figure).ok_or_else(|| format!("captions.md has no text for `{figure}`").into())
    }

    /// Parses `# file: title (name)`, `## section` and `### figure: title`, each with the lines
    /// that follow.
    fn read(text: &'static str) -> Self {
        let (mut pages, mut figures) = (Vec::<Page>::new(), BTreeMap::new());
        let mut section = "";
        for block in text.split("\n#").skip(1) {
            let (head, lines) = block.split_once('\n').unwrap_or((block, ""));
            if let Some(figure) = head.strip_prefix("## ") {
                let (figure, title) = figure.split_once(": ").unwrap_or((figure, figure));
                let (source, rest) = lines.split_once('\n').unwrap_or((lines, ""));
                let page = pages.last().map_or("", |page| page.file);
                figures.insert(figure, Caption { page, section, title, source, text: joined(rest) });
            } else if let Some(heading) = head.strip_prefix("# ") {
                section = heading;
            } else if let Some((file, title)) = head.trim().split_once(": ") {
                let (title, name) = title.trim_end_matches(')').split_once(" (").unwrap_or((title, title));
                pages.push(Page { file, title, name, about: joined(lines) });
            }
        }
        Self { pages, figures }
    }
}

/// Joins lines to one paragraph.
fn joined(lines: &str) -> String {
    lines.split_whitespace().collect::<Vec<_>>().join(" ")
}

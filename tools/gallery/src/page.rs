//! The gallery's pages: files next to their images, light and dark themes, without network access
//! or scripts.

use asperity::html::{escape, page};
use serde::{Deserialize, Serialize};

use crate::captions::{CAPTIONS, Caption, Page};
use crate::figure::{Drawn, Panel};

/// The page of the tables, relative to the gallery.
pub(crate) const TABLES: &str = "../tables/index.html";

/// The interactive web demo, relative to the gallery.
pub(crate) const LIVE: &str = "../web/index.html";

/// A rendered figure on disk, with its provenance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Record {
    pub(crate) name: String,
    pub(crate) seed: u32,
    pub(crate) seconds: f64,
    /// Identifies the program and the settings: equal keys give equal files.
    pub(crate) key: String,
    #[serde(flatten)]
    pub(crate) drawn: Drawn<Stored>,
}

/// An image on disk.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Stored {
    pub(crate) file: String,
    pub(crate) sha256: String,
    /// The smaller file that a page displays instead, and its hash.
    pub(crate) light: Option<(String, String)>,
    /// Width and height of a raster image; `None` for vector graphics.
    pub(crate) pixels: Option<(u32, u32)>,
}

/// Returns a `<table>` in its scrolling box.
pub(crate) fn table(head: &[String], rows: &[Vec<String>]) -> String {
    let row = |tag: &str, cells: &[String]| {
        let cells = cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", escape(cell)));
        format!("<tr>{}</tr>\n", cells.collect::<String>())
    };
    let rows: String = rows.iter().map(|cells| row("td", cells)).collect();
    format!("<div class=\"scroll\"><table>\n{}{rows}</table></div>\n", row("th", head))
}

impl Page {
    /// Whether one of the records is on the page.
    pub(crate) fn shows(&self, records: &[Record]) -> bool {
        records.iter().any(|record| CAPTIONS.of(&record.name).is_ok_and(|c| c.page == self.file))
    }

    /// Returns the page of its records. It links to other pages with records, to `tables` if there
    /// are any, and to the `live` page if it exists. `drawing` returns the text of an SVG file by
    /// name.
    pub(crate) fn gallery(
        &self,
        records: &[Record],
        [tables, live]: [Option<&str>; 2],
        drawing: impl Fn(&str) -> String,
    ) -> String {
        let prefix = if self.title == "Asperity" { String::new() } else { format!("{}: ", self.title) };
        let others = CAPTIONS.pages.iter().filter(|other| other.file != self.file && other.shows(records));
        let others = others.map(|other| {
            format!("<li><a class=\"page\" href=\"{}\">{} \u{2192}</a></li>\n", other.file, other.name)
        });
        let words = |record: &Record| CAPTIONS.of(&record.name).ok().filter(|c| c.page == self.file);
        let records: Vec<_> = records.iter().filter_map(|record| Some((words(record)?, record))).collect();
        let links = records.iter().map(|(caption, record)| {
            format!("<li><a href=\"#{}\">{}</a></li>\n", escape(&record.name), escape(caption.title))
        });
        let sections = records.chunk_by(|a, b| a.0.section == b.0.section).map(|records| {
            let articles: String = records.iter().map(|(words, r)| article(words, r, &drawing)).collect();
            format!("<section><h2>{}</h2>\n{articles}</section>\n", records[0].0.section)
        });
        let rest = format!(
            "<nav><div class=\"wide\"><ol>\n{}</ol></div></nav>\n<main class=\"wide\">\n{}</main>\n\
             <footer class=\"wide\">Asperity {}. The bytes of all files depend only on settings and seeds, not on \
             the number of threads.{}{}</footer>\n",
            others.chain(links).collect::<String>(),
            sections.collect::<String>(),
            env!("CARGO_PKG_VERSION"),
            tables.map_or_else(String::new, |file| {
                format!(" Tables used by the figures: <a href=\"{file}\">tables</a>.")
            }),
            live.map_or_else(
                || " <code>cargo xtask web</code> builds an interactive page.".to_owned(),
                |file| format!(" Interactive version: <a href=\"{file}\">live page</a>.")
            ),
        );
        page(&format!("{prefix}Asperity gallery"), self.title, &self.about, &rest)
    }
}

fn article(words: &Caption, record: &Record, drawing: &impl Fn(&str) -> String) -> String {
    let panel = |panel: &Panel<Stored>| {
        let (file, alt) = (escape(&panel.picture.file), escape(&panel.alt));
        let shown = panel.picture.light.as_ref().map_or_else(|| file.clone(), |light| escape(&light.0));
        let picture = match panel.picture.pixels {
            Some((width, height)) => format!(
                "<img src=\"{shown}\" width=\"{width}\" height=\"{height}\" loading=\"lazy\" alt=\"{alt}\">"
            ),
            None => drawing(&panel.picture.file),
        };
        format!(
            "<figure{} style=\"grid-column: span {}\"><a href=\"{file}\">{picture}</a><figcaption>{}</figcaption></figure>\n",
            if panel.span > 1 { " class=\"broad\"" } else { "" },
            panel.span.max(1),
            escape(&panel.label)
        )
    };
    let own = [
        ("seed".to_owned(), record.seed.to_string()),
        ("time".to_owned(), format!("{:.1} s", record.seconds)),
        ("render this figure".to_owned(), format!("cargo xtask gallery --only {}", record.name)),
    ];
    let fact = |(name, value): &(String, String)| {
        format!("<div><dt>{}</dt><dd>{}</dd></div>\n", escape(name), escape(value))
    };
    let drawn = &record.drawn;
    format!(
        "<article id=\"{}\">\n<h3>{}</h3>\n<p class=\"source\">{}</p>\n<p class=\"caption\">{}</p>\n\
         <div class=\"panels\" style=\"grid-template-columns: repeat({}, minmax(0, 1fr))\">\n{}</div>\n\
         <dl class=\"facts\">\n{}</dl>\n{}</article>\n",
        escape(&record.name),
        escape(words.title),
        escape(words.source),
        escape(&words.text),
        drawn.columns.max(1),
        drawn.panels.iter().map(panel).collect::<String>(),
        drawn.parameters.iter().chain(&own).map(fact).collect::<String>(),
        drawn.table.as_ref().map(|(head, rows)| table(head, rows)).unwrap_or_default(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(name: &str) -> Record {
        let picture =
            Stored { file: "far.png".into(), sha256: "00".into(), light: None, pixels: Some((8, 8)) };
        let (stem, label, alt) = ("far".into(), "A <sphere>".into(), "bumps & \"zoom\"".into());
        let panels = vec![Panel { stem, label, alt, span: 1, picture }];
        let parameters = vec![("alpha_x".into(), "0.2".into())];
        let table = Some((vec!["zoom".into()], vec![vec!["1".into()]]));
        let drawn = Drawn { columns: 2, panels, parameters, table };
        Record { name: name.into(), seed: 7, seconds: 1.25, key: "k".into(), drawn }
    }

    fn page_of(index: usize, names: &[&str]) -> String {
        let records: Vec<_> = names.iter().copied().map(record).collect();
        CAPTIONS.pages[index].gallery(&records, [TABLES, LIVE].map(Some), |_| String::new())
    }

    #[test]
    fn page_links_only_to_existing_parts() {
        let sphere = [record("kautz-1-sphere")];
        let page = CAPTIONS.pages[0].gallery(&sphere, [None; 2], |_| String::new());
        assert!(page.contains("href=\"#kautz-1-sphere\"") && !page.contains(".html\""), "{page}");
        assert!(CAPTIONS.pages[0].shows(&sphere) && !CAPTIONS.pages[1].shows(&sphere));
        let whole = page_of(0, &["kautz-1-sphere", "noise-kind-white"]);
        assert!(whole.contains("href=\"noise.html\"") && whole.contains(TABLES) && whole.contains(LIVE));
    }

    #[test]
    fn page_is_escaped_complete_and_without_network_or_scripts() {
        let page = page_of(0, &["kautz-1-sphere", "kautz-2-ndf"]);
        assert!(page.contains("A &lt;sphere&gt;") && page.contains("bumps &amp; &quot;zoom&quot;"));
        assert!(!page.contains("A <sphere>"));
        for banned in ["http:", "https:", "<script", "<link", "@import", "url("] {
            assert!(!page.contains(banned), "{banned}");
        }
        let tags = "article section figure dl table main nav ol li div html body";
        for tag in tags.split(' ') {
            let opened =
                page.matches(&format!("<{tag}>")).count() + page.matches(&format!("<{tag} ")).count();
            assert_eq!(opened, page.matches(&format!("</{tag}>")).count(), "{tag}");
        }
    }

    #[test]
    fn noise_figures_are_on_the_noise_page_and_pages_link_each_other() {
        let [sphere, noise] = ["kautz-1-sphere", "noise-kind-white"];
        for (index, own, foreign, other) in
            [(0, sphere, noise, "noise.html"), (1, noise, sphere, "index.html")]
        {
            let page = page_of(index, &[sphere, noise]);
            let has = |text: &str, name: &str| page.contains(&format!("{text}=\"{name}\""));
            assert!(has("id", own) && !has("id", foreign) && has("href", other), "{other}");
        }
    }

    #[test]
    fn every_image_links_to_its_file() {
        let (mut raster, mut vector) = (record("kautz-1-sphere"), record("kautz-2-ndf"));
        raster.drawn.panels[0].picture.light = Some(("far.jpg".into(), "00".into()));
        vector.drawn.panels[0].picture =
            Stored { file: "far.svg".into(), sha256: "00".into(), light: None, pixels: None };
        let page = CAPTIONS.pages[0].gallery(&[raster, vector], [None; 2], |_| "<svg></svg>".into());
        assert!(
            page.contains("<a href=\"far.png\"><img src=\"far.jpg\" ")
                && page.contains("<a href=\"far.svg\"><svg></svg></a>")
        );
    }

    #[test]
    fn record_round_trip() {
        let text = serde_json::to_string(&record("kautz-1-sphere")).unwrap();
        assert_eq!(serde_json::from_str::<Record>(&text).unwrap(), record("kautz-1-sphere"));
    }
}

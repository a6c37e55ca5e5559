//! The gallery's pages: files beside their pictures, light and dark, no network, no script.

use serde::{Deserialize, Serialize};

use crate::gallery::captions::{Page, captions};

const STYLE: &str = include_str!("page.css");

/// A drawn figure on disk: words, pictures with checksums, provenance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Record {
    pub(crate) name: String,
    pub(crate) title: String,
    pub(crate) source: String,
    pub(crate) caption: String,
    pub(crate) seed: u32,
    pub(crate) seconds: f64,
    /// Names the program and the settings that drew it: equal keys give equal files.
    pub(crate) key: String,
    pub(crate) columns: u32,
    pub(crate) panels: Vec<PanelRecord>,
    pub(crate) parameters: Vec<(String, String)>,
    pub(crate) table: Option<(Vec<String>, Vec<Vec<String>>)>,
}

/// One picture on disk.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct PanelRecord {
    pub(crate) file: String,
    pub(crate) sha256: String,
    pub(crate) label: String,
    pub(crate) alt: String,
    pub(crate) span: u32,
    /// Height over width of a raster picture in pixels; `None` for a drawing.
    pub(crate) pixels: Option<(u32, u32)>,
}

/// The page's colours, light and dark, for a picture that stands alone.
pub(crate) fn colours() -> &'static str {
    STYLE.split_once("* {").map_or(STYLE, |(colours, _)| colours)
}

/// Text made safe for element content and quoted attributes.
pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// The head of every page that the builder writes, up to and with the opening of `<body>`.
pub(crate) fn head(title: &str) -> String {
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n",
        escape(title)
    )
}

/// A `<table>` in its scrolling box.
pub(crate) fn table(head: &[String], rows: &[Vec<String>]) -> String {
    let row = |tag: &str, cells: &[String]| {
        let cells = cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", escape(cell)));
        format!("<tr>{}</tr>\n", cells.collect::<String>())
    };
    let rows: String = rows.iter().map(|cells| row("td", cells)).collect();
    format!("<div class=\"scroll\"><table>\n{}{rows}</table></div>\n", row("th", head))
}

impl Page {
    /// The page over its records; `drawing` hands over the text of an SVG file by its name.
    pub(crate) fn gallery(
        &self,
        records: &[Record],
        version: &str,
        drawing: impl Fn(&str) -> String,
    ) -> String {
        let prefix = if self.title == "Asperity" { String::new() } else { format!("{}: ", self.title) };
        let others = captions().pages.iter().filter(|other| other.file != self.file);
        let others = others
            .map(|o| format!("<li><a class=\"page\" href=\"{}\">{} \u{2192}</a></li>\n", o.file, o.name));
        let section_of = |record: &Record| {
            let caption = captions().of(&record.name).ok().filter(|caption| caption.page == self.file);
            caption.map(|caption| caption.section)
        };
        let records: Vec<_> = records.iter().filter_map(|r| Some((section_of(r)?, r))).collect();
        let links = records
            .iter()
            .map(|(_, r)| format!("<li><a href=\"#{}\">{}</a></li>\n", escape(&r.name), escape(&r.title)));
        let sections = records.chunk_by(|a, b| a.0 == b.0).map(|records| {
            let articles: String = records.iter().map(|(_, record)| article(record, &drawing)).collect();
            format!("<section><h2>{}</h2>\n{articles}</section>\n", records[0].0)
        });
        format!(
            "{head}<div class=\"wide\"><header><h1>{title}</h1>\n<p>{about}</p></header></div>\n\
             <nav><div class=\"wide\"><ol>\n{others}{links}</ol></div></nav>\n\
             <main class=\"wide\">\n{sections}</main>\n\
             <footer class=\"wide\">Asperity {version}. The same settings and seeds give the same files, byte for \
             byte, on any number of threads. The tables behind the pictures: \
             <a href=\"../tables/index.html\">tables</a>.</footer>\n</body>\n</html>\n",
            head = head(&format!("{prefix}Asperity gallery")),
            title = escape(self.title),
            about = escape(&self.about),
            others = others.collect::<String>(),
            links = links.collect::<String>(),
            sections = sections.collect::<String>(),
            version = escape(version),
        )
    }
}

fn article(record: &Record, drawing: &impl Fn(&str) -> String) -> String {
    let panel = |panel: &PanelRecord| {
        let picture = match panel.pixels {
            Some((width, height)) => format!(
                "<a href=\"{file}\"><img src=\"{file}\" width=\"{width}\" height=\"{height}\" loading=\"lazy\" \
                 alt=\"{}\"></a>",
                escape(&panel.alt),
                file = escape(&panel.file),
            ),
            None => drawing(&panel.file),
        };
        format!(
            "<figure{} style=\"grid-column: span {}\">{picture}<figcaption>{}</figcaption></figure>\n",
            if panel.span > 1 { " class=\"broad\"" } else { "" },
            panel.span.max(1),
            escape(&panel.label)
        )
    };
    let own = [
        ("seed".to_owned(), record.seed.to_string()),
        ("time".to_owned(), format!("{:.1} s", record.seconds)),
        ("draw it alone".to_owned(), format!("cargo xtask gallery --only {}", record.name)),
    ];
    let fact = |(name, value): &(String, String)| {
        format!("<div><dt>{}</dt><dd>{}</dd></div>\n", escape(name), escape(value))
    };
    format!(
        "<article id=\"{}\">\n<h3>{}</h3>\n<p class=\"source\">{}</p>\n<p class=\"caption\">{}</p>\n\
         <div class=\"panels\" style=\"grid-template-columns: repeat({}, minmax(0, 1fr))\">\n{}</div>\n\
         <dl class=\"facts\">\n{}</dl>\n{}</article>\n",
        escape(&record.name),
        escape(&record.title),
        escape(&record.source),
        escape(&record.caption),
        record.columns.max(1),
        record.panels.iter().map(panel).collect::<String>(),
        record.parameters.iter().chain(&own).map(fact).collect::<String>(),
        record.table.as_ref().map(|(head, rows)| table(head, rows)).unwrap_or_default(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record() -> Record {
        Record {
            name: "kautz-1-sphere".into(),
            title: "A <sphere>".into(),
            source: "fig. 1".into(),
            caption: "bumps & \"zoom\"".into(),
            seed: 7,
            seconds: 1.25,
            key: "k".into(),
            columns: 2,
            panels: vec![PanelRecord {
                file: "kautz-1-sphere-far.png".into(),
                sha256: "00".into(),
                label: "far".into(),
                alt: "a sphere".into(),
                span: 1,
                pixels: Some((8, 8)),
            }],
            parameters: vec![("alpha_x".into(), "0.2".into())],
            table: Some((vec!["zoom".into()], vec![vec!["1".into()]])),
        }
    }

    #[test]
    fn text_from_outside_cannot_become_markup() {
        let page = captions().pages[0].gallery(&[record()], "0.1.0", |_| String::new());
        assert!(page.contains("A &lt;sphere&gt;") && page.contains("bumps &amp; &quot;zoom&quot;"));
        assert!(!page.contains("A <sphere>"));
    }

    #[test]
    fn the_page_needs_no_network_and_no_script() {
        let page = captions().pages[0].gallery(&[record()], "0.1.0", |_| String::new());
        for banned in ["http:", "https:", "<script", "<link", "@import", "url("] {
            assert!(!page.contains(banned), "{banned}");
        }
    }

    #[test]
    fn a_figure_of_noise_is_on_the_page_of_noise_alone_and_pages_know_one_another() {
        let noise = Record { name: "noise-kind-white".into(), title: "White".into(), ..record() };
        let [first, second] = [0, 1].map(|k: usize| {
            captions().pages[k].gallery(&[record(), noise.clone()], "0.1.0", |_| String::new())
        });
        assert!(
            first.contains("A &lt;sphere&gt;")
                && !first.contains("White")
                && first.contains("href=\"noise.html\"")
        );
        assert!(
            second.contains("White")
                && !second.contains("A &lt;sphere")
                && second.contains("href=\"index.html\"")
        );
    }

    #[test]
    fn every_opened_element_is_closed() {
        let page = captions().pages[0].gallery(&[record(), record()], "0.1.0", |_| String::new());
        for tag in
            ["article", "section", "figure", "dl", "table", "main", "nav", "ol", "li", "div", "html", "body"]
        {
            let opened =
                page.matches(&format!("<{tag}>")).count() + page.matches(&format!("<{tag} ")).count();
            assert_eq!(opened, page.matches(&format!("</{tag}>")).count(), "{tag}");
        }
    }

    #[test]
    fn a_record_survives_its_file() {
        let text = serde_json::to_string(&record()).unwrap();
        assert_eq!(serde_json::from_str::<Record>(&text).unwrap(), record());
    }
}

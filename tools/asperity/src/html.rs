//! The frame of generated pages: style, title and heading, without scripts or network access.

const STYLE: &str = include_str!("page.css");

/// Returns a named color of the page for the light and the dark theme.
pub fn color(name: &str) -> [&'static str; 2] {
    let name = format!("--{name}: ");
    let value = |rest: &'static str| rest.split(';').next();
    let mut values = STYLE.split(name.as_str()).skip(1).filter_map(value);
    [(); 2].map(|()| values.next().unwrap_or("currentColor"))
}

/// Escapes text for element content and quoted attributes.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Returns a whole page: title, heading with an introduction, and body.
pub fn page(title: &str, heading: &str, about: &str, rest: &str) -> String {
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <div class=\"wide\"><header><h1>{}</h1>\n<p>{}</p></header></div>\n{rest}</body>\n</html>\n",
        escape(title),
        escape(heading),
        escape(about),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn color_has_light_and_dark_value() {
        assert_eq!(color("card"), ["#ffffff", "#1b1d1f"]);
        assert_eq!(color("series-4"), ["#8a3b8f", "#d394dc"]);
    }
}

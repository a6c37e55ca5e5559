//! JSON as a script of a page reads it.

use std::fmt::Write;

/// A value.
pub(super) enum Json {
    Text(String),
    Number(u64),
    List(Vec<Self>),
    Object(Vec<(&'static str, Self)>),
}

impl Json {
    pub(super) fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    pub(super) fn texts<T: Into<String>>(texts: impl IntoIterator<Item = T>) -> Self {
        Self::List(texts.into_iter().map(Self::text).collect())
    }

    /// Appends the value; `<` is escaped, so that no text ends the script that holds it.
    pub(super) fn write(&self, out: &mut String) {
        match self {
            Self::Text(text) => {
                out.push('"');
                for c in text.chars() {
                    match c {
                        '"' => out.push_str("\\\""),
                        '\\' => out.push_str("\\\\"),
                        '\n' => out.push_str("\\n"),
                        '<' => out.push_str("\\u003c"),
                        c if c < ' ' => _ = write!(out, "\\u{:04x}", u32::from(c)),
                        c => out.push(c),
                    }
                }
                out.push('"');
            }
            Self::Number(number) => _ = write!(out, "{number}"),
            Self::List(values) => {
                out.push('[');
                for (i, value) in values.iter().enumerate() {
                    if i > 0 {
                        out.push(',');
                    }
                    value.write(out);
                }
                out.push(']');
            }
            Self::Object(fields) => {
                out.push('{');
                for (i, (name, value)) in fields.iter().enumerate() {
                    let comma = if i > 0 { "," } else { "" };
                    _ = write!(out, "{comma}\"{name}\":");
                    value.write(out);
                }
                out.push('}');
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_end_neither_themselves_nor_their_script() {
        let mut out = String::new();
        let list = Json::List(vec![Json::text("a\"b\\c\n\u{1}</script>"), Json::Number(3)]);
        Json::Object(vec![("k", list), ("l", Json::List(vec![]))]).write(&mut out);
        assert_eq!(out, r#"{"k":["a\"b\\c\n\u0001\u003c/script>",3],"l":[]}"#);
    }
}

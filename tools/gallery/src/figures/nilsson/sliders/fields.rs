//! Formats the fields of a struct from its `Debug` output.

use std::fmt::Debug;

/// Formats values. For structs, only the differing fields are listed.
pub(super) fn varied(values: &[String]) -> Vec<String> {
    let inner: Vec<_> = values.iter().map(|value| parts(value)).collect();
    let differs = |k: usize| inner.iter().any(|fields| fields.get(k) != inner[0].get(k));
    let words = |(value, fields): (&String, &Vec<(String, String)>)| {
        let varied: Vec<_> = (0..fields.len())
            .filter(|&k| fields.len() > 1 && differs(k))
            .map(|k| format!("{} {}", fields[k].0, fields[k].1))
            .collect();
        if varied.is_empty() { value.clone() } else { varied.join(", ") }
    };
    values.iter().zip(&inner).map(words).collect()
}

/// Returns the names and values of a struct's fields, as in its `Debug` output.
pub(super) fn fields(parameters: &impl Debug) -> Vec<(String, String)> {
    parts(&format!("{parameters:?}").replace("Vec2(", "(").replace("Vec3(", "("))
}

/// Returns the names and values of the fields of a struct on one line.
fn parts(text: &str) -> Vec<(String, String)> {
    let text = text.split_once(" { ").map_or("", |(_, fields)| fields);
    let mut fields = Vec::<String>::new();
    for part in text.strip_suffix(" }").unwrap_or(text).split(", ") {
        match fields.last_mut() {
            Some(field) if field.matches(['(', '{']).count() > field.matches([')', '}']).count() => {
                *field += &format!(", {part}");
            }
            _ => fields.push(part.to_owned()),
        }
    }
    let named = fields.iter().filter_map(|field| field.split_once(": "));
    named.map(|(name, value)| (name.to_owned(), rounded(value))).collect()
}

/// Removes zero fractions of numbers.
fn rounded(value: &str) -> String {
    let whole = value.replace(".0,", ",").replace(".0)", ")").replace(".0 ", " ");
    whole.strip_suffix(".0").unwrap_or(&whole).to_owned()
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn fields_are_parsed_with_their_values() {
        let parameters = Sphere { center: Vec3::new(0.5, 1.0, 0.0), radius: Some(2.0) };
        let expected = [("center", "(0.5, 1, 0)"), ("radius", "Some(2)")];
        assert_eq!(fields(&parameters), expected.map(|(a, b)| (a.to_owned(), b.to_owned())));
    }

    #[derive(Debug)]
    #[expect(dead_code, reason = "only its text is read")]
    struct Sphere {
        center: Vec3,
        radius: Option<f32>,
    }

    #[test]
    fn varied_lists_only_differing_fields() {
        let values = ["A { b: 1, c: 2 }", "A { b: 1, c: 3 }"].map(str::to_owned);
        assert_eq!(varied(&values), ["c 2", "c 3"]);
        let values = ["None", "Some { unit: 3 }"].map(str::to_owned);
        assert_eq!(varied(&values), values);
    }
}

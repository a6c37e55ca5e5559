//! Edits of a JSON text that keep the bytes of everything else.

use std::fmt;

use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;

use crate::failure::Result;

/// The members of an object in order, each value as its text.
struct Members<'a>(Vec<(String, &'a RawValue)>);

impl<'de> Deserialize<'de> for Members<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct InOrder;
        impl<'de> Visitor<'de> for InOrder {
            type Value = Members<'de>;

            fn expecting(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
                to.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Members<'de>, A::Error> {
                let mut members = Vec::new();
                while let Some(member) = map.next_entry()? {
                    members.push(member);
                }
                Ok(Members(members))
            }
        }
        deserializer.deserialize_map(InOrder)
    }
}

/// Returns the text of a member of an object; `None` if it is `null`.
pub(super) fn member<'a>(object: &'a str, key: &str) -> Result<Option<&'a str>> {
    let Members(members) = serde_json::from_str(object)?;
    let value = members.into_iter().rev().find(|(name, _)| name == key).map(|(_, value)| value.get());
    Ok(value.filter(|value| *value != "null"))
}

/// Returns the texts of the items of a list.
pub(super) fn items(list: &str) -> Result<Vec<&str>> {
    let items: Vec<&RawValue> = serde_json::from_str(list)?;
    Ok(items.into_iter().map(RawValue::get).collect())
}

/// Replaces members of an object, and appends those that it lacks.
pub(super) fn set(object: &str, members: &[(&str, String)]) -> Result<String> {
    let Members(old) = serde_json::from_str(object)?;
    let mut pieces = Pieces::new(object);
    for (name, value) in &old {
        if let Some((_, new)) = members.iter().find(|(key, _)| key == name) {
            pieces.replace(value.get(), new);
        }
    }
    let new = members.iter().filter(|(key, _)| old.iter().all(|(name, _)| name != key));
    let new = new.map(|(key, value)| Ok(format!("{}:{value}", serde_json::to_string(key)?)));
    let new = new.collect::<Result<Vec<_>>>()?;
    Ok(pieces.end(old.last().map(|(_, value)| value.get()), &new))
}

/// Replaces the items of a list at these positions, and appends others.
pub(super) fn edit(list: &str, replaced: &[(usize, String)], appended: &[String]) -> Result<String> {
    let old = items(list)?;
    let mut pieces = Pieces::new(list);
    for (index, item) in old.iter().enumerate() {
        if let Some((_, new)) = replaced.iter().find(|(at, _)| *at == index) {
            pieces.replace(item, new);
        }
    }
    Ok(pieces.end(old.last().copied(), appended))
}

/// A text that is copied piece by piece.
struct Pieces<'a> {
    text: &'a str,
    copied: usize,
    out: String,
}

impl<'a> Pieces<'a> {
    fn new(text: &'a str) -> Self {
        Self { text, copied: 0, out: String::with_capacity(text.len()) }
    }

    /// Returns the position of a part of the text.
    fn offset(&self, part: &str) -> usize {
        part.as_ptr().addr().saturating_sub(self.text.as_ptr().addr()).min(self.text.len())
    }

    /// Replaces a later part of the text.
    fn replace(&mut self, part: &str, new: &str) {
        let at = self.offset(part);
        self.out += self.text.get(self.copied..at).unwrap_or_default();
        self.out += new;
        self.copied = at + part.len();
    }

    /// Inserts entries after the last entry, and copies the rest.
    fn end(mut self, last: Option<&str>, new: &[String]) -> String {
        let at = match last {
            Some(last) => self.offset(last) + last.len(),
            None => self.text.find(['{', '[']).map_or(0, |at| at + 1),
        };
        let at = at.max(self.copied);
        self.out += self.text.get(self.copied..at).unwrap_or_default();
        for (k, entry) in new.iter().enumerate() {
            if k > 0 || last.is_some() {
                self.out.push(',');
            }
            self.out += entry;
        }
        self.out += self.text.get(at..).unwrap_or_default();
        self.out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn set_keeps_order_numbers_and_spaces() {
        let text = "{ \"z\" : 1.50e0,\n \"a\":{\"index\": 007e-1} , \"b\":[1, 2]\n}".replace("007", "7");
        let got = set(&text, &[("a", "0.5".into()), ("new\"", "[]".into())]).unwrap();
        assert_eq!(got, "{ \"z\" : 1.50e0,\n \"a\":0.5 , \"b\":[1, 2],\"new\\\"\":[]\n}");
        assert_eq!(set("{ }", &[("a", "1".into()), ("b", "2".into())]).unwrap(), "{\"a\":1,\"b\":2 }");
        assert_eq!(member(&text, "b").unwrap(), Some("[1, 2]"));
        assert_eq!(member(&text, "c").unwrap(), None);
        assert_eq!(member("{\"c\":\nnull }", "c").unwrap(), None);
        assert!(set("[1]", &[]).is_err() && member("{\"a\":", "a").is_err());
    }

    #[test]
    fn edit_replaces_and_appends() {
        let got = edit("[ {\"é\":1}, 2 ,3 ]", &[(1, "two".into())], &["4".into(), "5".into()]).unwrap();
        assert_eq!(got, "[ {\"é\":1}, two ,3,4,5 ]");
        assert_eq!(edit("[\n]", &[], &["4".into()]).unwrap(), "[4\n]");
        assert!(edit("{}", &[], &[]).is_err());
    }
}

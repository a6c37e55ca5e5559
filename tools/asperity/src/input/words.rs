//! Options whose values are words of a table.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

/// Words accepted by an option, each with its help text and its meaning.
pub type Words<T> = [(&'static str, &'static str, T)];

/// Returns a parser from the words of a table to their meanings.
pub fn one_of<T: Copy + Send + Sync>(words: &'static Words<T>) -> impl TypedValueParser<Value = T> {
    let values = words.iter().map(|(word, help, _)| PossibleValue::new(*word).help(*help));
    PossibleValuesParser::new(values).try_map(|said| {
        let meant = words.iter().find(|(word, ..)| *word == said);
        meant.map(|(_, _, meaning)| *meaning).ok_or("unknown value")
    })
}

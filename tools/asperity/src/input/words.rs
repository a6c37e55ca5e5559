//! Options whose values are words of a table.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

/// Words that an option takes: each with its help and its meaning.
pub type Words<T> = [(&'static str, &'static str, T)];

/// A parser of the words of a table into what they mean.
pub fn one_of<T: Copy + Send + Sync>(words: &'static Words<T>) -> impl TypedValueParser<Value = T> {
    let values = words.iter().map(|(word, help, _)| PossibleValue::new(*word).help(*help));
    PossibleValuesParser::new(values).try_map(|said| {
        let meant = words.iter().find(|(word, ..)| *word == said);
        meant.map(|(_, _, meaning)| *meaning).ok_or("an unknown word")
    })
}

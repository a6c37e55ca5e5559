//! The module's exports, and its needs in place of std.
//!
//! A caller asks for room, writes numbers and words there, calls `ask` with the number of a question, and reads words where
//! `answer` says, or bytes of a sentence where `ask` returned 1.

use alloc::{string::String, vec::Vec};
use core::cell::RefCell;

use crate::QUESTIONS;

#[global_allocator]
static ALLOCATOR: dlmalloc::GlobalDlmalloc = dlmalloc::GlobalDlmalloc;

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}

/// What is kept between calls.
struct Kept {
    numbers: Vec<f64>,
    bulk: Vec<u32>,
    answer: Vec<u32>,
    sentence: String,
}

struct Alone(RefCell<Kept>);

// SAFETY: a module without threads.
unsafe impl Sync for Alone {}

static KEPT: Alone = Alone(RefCell::new(Kept {
    numbers: Vec::new(),
    bulk: Vec::new(),
    answer: Vec::new(),
    sentence: String::new(),
}));

/// Room for so many numbers.
#[unsafe(no_mangle)]
pub extern "C" fn numbers(count: usize) -> *mut f64 {
    let mut kept = KEPT.0.borrow_mut();
    kept.numbers.clear();
    kept.numbers.resize(count, 0.0);
    kept.numbers.as_mut_ptr()
}

/// Room for so many words.
#[unsafe(no_mangle)]
pub extern "C" fn bulk(count: usize) -> *mut u32 {
    let mut kept = KEPT.0.borrow_mut();
    kept.bulk.clear();
    kept.bulk.resize(count, 0);
    kept.bulk.as_mut_ptr()
}

/// The name of a question: its address; the length is that of the sentence.
#[unsafe(no_mangle)]
pub extern "C" fn question(number: usize) -> usize {
    let mut kept = KEPT.0.borrow_mut();
    kept.sentence = QUESTIONS.get(number).map(|(name, _)| String::from(*name)).unwrap_or_default();
    kept.sentence.len()
}

/// Answers a question: 0 and words, or 1 and a sentence.
#[unsafe(no_mangle)]
pub extern "C" fn ask(number: usize) -> u32 {
    let mut kept = KEPT.0.borrow_mut();
    let Some((_, question)) = QUESTIONS.get(number) else { return 1 };
    match question(&kept.numbers, &kept.bulk) {
        Ok(answer) => {
            kept.answer = answer;
            0
        }
        Err(sentence) => {
            kept.sentence = sentence;
            1
        }
    }
}

/// The address of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> *const u32 {
    KEPT.0.borrow().answer.as_ptr()
}

/// Words of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn answer_length() -> usize {
    KEPT.0.borrow().answer.len()
}

/// The address of the sentence.
#[unsafe(no_mangle)]
pub extern "C" fn sentence() -> *const u8 {
    KEPT.0.borrow().sentence.as_ptr()
}

/// Bytes of the sentence.
#[unsafe(no_mangle)]
pub extern "C" fn sentence_length() -> usize {
    KEPT.0.borrow().sentence.len()
}

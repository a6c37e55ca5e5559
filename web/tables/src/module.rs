//! The module's exports, and its replacements for std.
//!
//! A caller allocates room, writes numbers and words there, and calls `ask` with the number of a
//! query. It then reads words at `answer`, or the bytes of a sentence if `ask` returned 1.

use alloc::{string::String, vec::Vec};
use core::cell::RefCell;

use crate::QUESTIONS;

#[global_allocator]
static ALLOCATOR: dlmalloc::GlobalDlmalloc = dlmalloc::GlobalDlmalloc;

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}

/// State between calls.
struct Kept {
    numbers: Vec<f64>,
    bulk: Vec<u32>,
    answer: Vec<u32>,
    sentence: String,
}

struct Alone(RefCell<Kept>);

// SAFETY: the module has no threads.
unsafe impl Sync for Alone {}

static KEPT: Alone = Alone(RefCell::new(Kept {
    numbers: Vec::new(),
    bulk: Vec::new(),
    answer: Vec::new(),
    sentence: String::new(),
}));

/// Allocates room for `count` numbers.
#[unsafe(no_mangle)]
pub extern "C" fn numbers(count: usize) -> *mut f64 {
    let mut kept = KEPT.0.borrow_mut();
    kept.numbers.clear();
    kept.numbers.resize(count, 0.0);
    kept.numbers.as_mut_ptr()
}

/// Allocates room for `count` words.
#[unsafe(no_mangle)]
pub extern "C" fn bulk(count: usize) -> *mut u32 {
    let mut kept = KEPT.0.borrow_mut();
    kept.bulk.clear();
    kept.bulk.resize(count, 0);
    kept.bulk.as_mut_ptr()
}

/// Returns the address of a query's name. The length is returned by `sentence_length`.
#[unsafe(no_mangle)]
pub extern "C" fn question(number: usize) -> usize {
    let mut kept = KEPT.0.borrow_mut();
    kept.sentence = QUESTIONS.get(number).map(|(name, _)| String::from(*name)).unwrap_or_default();
    kept.sentence.len()
}

/// Runs a query: 0 and words, or 1 and a sentence.
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

/// Returns the address of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> *const u32 {
    KEPT.0.borrow().answer.as_ptr()
}

/// Returns the number of words of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn answer_length() -> usize {
    KEPT.0.borrow().answer.len()
}

/// Returns the address of the sentence.
#[unsafe(no_mangle)]
pub extern "C" fn sentence() -> *const u8 {
    KEPT.0.borrow().sentence.as_ptr()
}

/// Returns the number of bytes of the sentence.
#[unsafe(no_mangle)]
pub extern "C" fn sentence_length() -> usize {
    KEPT.0.borrow().sentence.len()
}

//! SPIR-V whose arithmetic is computed as it is written.

const ANNOTATIONS_END_BEFORE: [u32; 21] =
    [19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39];
/// `OpFNegate` is exact; these round: sums, products, quotients, remainders, products with scalars, of matrices, and dots.
const ROUNDED: [u32; 13] = [129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148];
const DECORATE: u32 = 71;
const NO_CONTRACTION: u32 = 42;
const HEADER: usize = 5;

/// The module with `OpDecorate %x NoContraction` on every sum, product and quotient, so that drivers may not fuse them.
pub(crate) fn without_contraction(words: &[u32]) -> Vec<u32> {
    let mut decorations = vec![];
    let (mut at, mut types) = (HEADER, None);
    while let Some(&first) = words.get(at) {
        let (length, code) = ((first >> 16) as usize, first & 0xFFFF);
        if types.is_none() && ANNOTATIONS_END_BEFORE.contains(&code) {
            types = Some(at);
        }
        if let (true, Some(&result)) = (ROUNDED.contains(&code), words.get(at + 2)) {
            decorations.extend([3 << 16 | DECORATE, result, NO_CONTRACTION]);
        }
        at += length.max(1);
    }
    let types = types.unwrap_or(words.len());
    [&words[..types], &decorations, &words[types..]].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_rounds_is_decorated_before_the_types() {
        let add = [5 << 16 | 129, 2, 7, 8, 9];
        let integer = [5 << 16 | 128, 2, 10, 8, 9];
        let module = [&[0; HEADER][..], &[2 << 16 | 19, 1], &add, &integer].concat();
        let got = without_contraction(&module);
        assert_eq!(got[HEADER..HEADER + 3], [3 << 16 | DECORATE, 7, NO_CONTRACTION]);
        assert_eq!(got.len(), module.len() + 3);
        assert_eq!(got[HEADER + 3..], module[HEADER..]);
    }
}

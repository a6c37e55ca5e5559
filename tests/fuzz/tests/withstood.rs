//! Every fuzz target with its seeds, corrupted seeds, and numbers of every class: a short fuzzing
//! run.

use asperity_fuzz::{ATTACKS, attack, seeds};

/// A PCG generator of bytes.
struct Bytes(u64);

impl Bytes {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    fn below(&mut self, most: usize) -> usize {
        self.next() as usize % most.max(1)
    }

    /// Returns a file with some bytes changed, removed, duplicated or truncated.
    fn spoilt(&mut self, file: &[u8]) -> Vec<u8> {
        let mut file = file.to_vec();
        for _ in 0..=self.below(4) {
            let at = self.below(file.len());
            match (self.next() % 6, file.len()) {
                (_, 0) => file.push(self.next() as u8),
                (0, _) => file[at] = self.next() as u8,
                (1, _) => file[at] ^= 1 << (self.next() % 8),
                (2, _) => file[at] = [0, 0x7f, 0x80, 0xff][self.below(4)],
                (3, _) => file.truncate(at),
                (4, _) => drop(file.remove(at)),
                _ => file.extend_from_within(at..(at + 40).min(file.len())),
            }
        }
        file
    }
}

/// Runs all fuzz targets with file or text input, or all with numeric input.
fn withstood(files: bool, rounds: usize) {
    for (name, _) in ATTACKS {
        let mut bytes = Bytes(2026);
        let seeds = seeds::of(name);
        assert!(!seeds.is_empty(), "{name}");
        let is_file = ["png", "exr", "picture", "mesh", "gltf", "json", "words"].contains(&name);
        if is_file != files {
            continue;
        }
        for seed in &seeds {
            attack(name, seed);
        }
        for round in 0..rounds {
            let input = if files {
                bytes.spoilt(&seeds[round % seeds.len()])
            } else {
                let length = 40 + bytes.below(600);
                (0..length).map(|_| bytes.next() as u8).collect()
            };
            attack(name, &input);
        }
    }
}

#[test]
fn files_and_text_of_any_bytes() {
    withstood(true, 20_000);
}

#[test]
fn numbers_of_every_class() {
    withstood(false, 50_000);
}

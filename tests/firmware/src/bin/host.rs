//! Renders the image on this machine, or writes the table of the density with the argument
//! `tables`.

use std::io::{self, Write};

use asperity_firmware::{HEADER, START, density, draw, hash};
use asperity_ndf_sampling::{Measure, NdfMap, Reconstruction};

fn main() -> io::Result<()> {
    let mut out = io::stdout().lock();
    if std::env::args().nth(1).as_deref() == Some("tables") {
        return out.write_all(&tables());
    }
    let (mut rows, mut digest) = (Vec::new(), START);
    let whole = draw(&mut |row| {
        digest = hash(digest, row);
        rows.extend_from_slice(row);
    });
    assert!(whole, "a table is refused");
    out.write_all(HEADER)?;
    out.write_all(&rows)?;
    eprintln!("hash  {digest:08x}");
    Ok(())
}

fn tables() -> Vec<u8> {
    let map = NdfMap::from_fn(16, 12, Measure::SolidAngle, Reconstruction::Bilinear, density);
    let array = map.expect("a density that is positive").into_array();
    array.into_iter().flat_map(f32::to_le_bytes).collect()
}

// Value and slope of a smooth function from one table: `asperity_fif::Table::jet`.

// f(x), with the bits of `fif_table_value`, and f'(x). At the ends of the domain and outside f' is
// the slope of the end; it is 0 for a function that is not smooth. NaN is returned unchanged.
fn fif_table_jet(table: FifTable, x: f32) -> vec2<f32> {
    if !fif_is_number(x) {
        return vec2<f32>(x, x);
    }
    let t = (x - table.origin) * table.per_width;
    let starts = !(t > 0.0);
    let ends = !(t < 1.0);
    var rest = vec2<u32>(0u, 0u);
    if ends {
        rest = vec2<u32>(0xffffffffu, 0xffffffffu);
    } else if !starts {
        rest = fif_table_fraction(t);
    }
    var sum = table.start + table.rise * t;
    var weight = 1.0;
    var left = table.steps;
    var slope = table.rise;
    var steep = f32(table.radix);
    for (var k = 0u; k < max(table.steps, table.slope_steps); k++) {
        let next = fif_table_digit(rest, table.radix);
        rest = next.yz;
        let row = fif_table_row(table, next.x);
        let s = f32(rest.x >> 8u);
        if left > 0u {
            sum += weight * ((row.w * s + row.z) * s + row.y);
            weight *= row.x;
            left -= 1u;
            if (rest.x | rest.y) == 0u {
                left = 0u;
                weight = 0.0;
            }
        }
        // The unit of powers is 2^-24.
        slope += steep * (((row.w + row.w) * s + row.z) * 16777216.0);
        steep *= row.x * f32(table.radix);
    }
    slope += steep * table.slope_middle;
    var value = sum + weight * table.middle;
    if starts {
        value = table.start;
    } else if ends {
        value = table.last;
    }
    return vec2<f32>(value, select(0.0, slope * table.per_width, table.slope_steps > 0u));
}

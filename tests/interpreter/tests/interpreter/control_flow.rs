//! Branches and loops with diverging points.

use crate::interpreter;

/// Calls a function of one number at 0 to 99 together, and at each alone.
#[track_caller]
fn agree(wgsl: &str, expected: impl Fn(i32) -> i32) {
    let shader = interpreter(wgsl);
    let inputs: Vec<[u32; 1]> = (0..100).map(|x| [x]).collect();
    let together = shader.call_many("f", &inputs).expect("numbers");
    for (x, value) in (0..100).zip(together) {
        assert_eq!(value.i32(), expected(x), "f({x})");
        assert_eq!(shader.call("f", &[x.into()]), Ok(value), "f({x}) alone");
    }
}

#[test]
fn branches_with_returns() {
    let wgsl = "
        fn f(x: i32) -> i32 {
            var y = x;
            if x % 3 == 0 { return 7; } else if x % 5 == 0 { y = y * 2; if x > 50 { return y + 1; } }
            if y > 20 { y -= 100; }
            return y;
        }";
    agree(wgsl, |x| match x {
        x if x % 3 == 0 => 7,
        x if x % 5 == 0 && x > 50 => 2 * x + 1,
        x => {
            let y = if x % 5 == 0 { 2 * x } else { x };
            if y > 20 { y - 100 } else { y }
        }
    });
}

#[test]
fn loops_with_breaks_and_continues() {
    let wgsl = "
        fn f(x: i32) -> i32 {
            var sum = 0;
            for (var i = 0; i < x; i++) {
                if (i + x) % 4 == 1 { continue; }
                var j = i;
                while j > 0 {
                    if j == 13 { break; }
                    if sum > 2000 { return -sum; }
                    sum += j;
                    j = j / 2;
                }
                if i > 60 { break; }
            }
            return sum;
        }";
    agree(wgsl, |x| {
        let mut sum = 0;
        for i in 0..x {
            if (i + x) % 4 == 1 {
                continue;
            }
            let mut j = i;
            while j > 0 && j != 13 {
                if sum > 2000 {
                    return -sum;
                }
                sum += j;
                j /= 2;
            }
            if i > 60 {
                break;
            }
        }
        sum
    });
}

#[test]
fn loops_with_continuing_block() {
    let wgsl = "
        fn f(x: i32) -> i32 {
            var n = x;
            var steps = 0;
            loop {
                if n < 2 { break; }
                if n % 2 == 0 { n = n / 2; continue; }
                n = 3 * n + 1;
                continuing { steps++; break if steps == 25; }
            }
            return steps;
        }";
    agree(wgsl, |x| {
        let (mut n, mut steps) = (x, 0);
        while n >= 2 && steps < 25 {
            n = if n % 2 == 0 { n / 2 } else { 3 * n + 1 };
            steps += 1;
        }
        steps
    });
}

#[test]
fn switches() {
    let wgsl = "
        fn f(x: i32) -> i32 {
            var y = 0;
            for (var i = 0; i < 3; i++) {
                switch (x + i) % 7 {
                    case 0, 3: { y += 1; }
                    case 1: { if x > 30 { break; } y += 10; }
                    case 2: { continue; }
                    case 4: { return -x; }
                    default: { y += 100; }
                }
                y *= 2;
            }
            return y;
        }";
    agree(wgsl, |x| {
        let mut y = 0;
        for i in 0..3 {
            y += match (x + i) % 7 {
                0 | 3 => 1,
                1 => i32::from(x <= 30) * 10,
                2 => continue,
                4 => return -x,
                _ => 100,
            };
            y *= 2;
        }
        y
    });
}

#[test]
fn functions_called_from_several_branches() {
    let wgsl = "
        fn root(x: i32) -> i32 {
            var r = 0;
            while (r + 1) * (r + 1) <= x { r++; }
            return r;
        }
        fn f(x: i32) -> i32 {
            let first = root(x);
            if x % 2 == 0 { return first + 100 * root(2 * x); }
            let second = root(3 * x);
            return first + 1000 * second;
        }";
    agree(wgsl, |x: i32| {
        let root = |x: i32| x.isqrt();
        root(x) + if x % 2 == 0 { 100 * root(2 * x) } else { 1000 * root(3 * x) }
    });
}

#[test]
fn infinite_loop_is_an_error() {
    let shader = interpreter("fn f() -> i32 { var x = 0; loop { x++; if x < 0 { x = 0; } } return x; }");
    assert!(shader.call("f", &[]).unwrap_err().contains("loops exceed 1000000 iterations, in `f`"));
}

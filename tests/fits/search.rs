//! Searches of one variable against closed forms.

use rockfrag::statistics::{minimum, root};

#[test]
fn roots_and_minima_are_found_where_calculus_puts_them() {
    let cubic = |x: f64| Some(x * x * x - 2.0);
    assert!((root(cubic, (0.0, 2.0), 1e-12).unwrap() - 2f64.cbrt()).abs() < 1e-11);
    let valley = |x: f64| Some(x - x.ln());
    assert!((minimum(valley, (0.2, 3.0), 1e-9).unwrap() - 1.0).abs() < 1e-7);
}

#[test]
fn without_a_change_of_sign_or_a_value_nothing_is_found() {
    assert_eq!(root(|x| Some(x * x + 1.0), (-1.0, 1.0), 1e-9), None);
    assert_eq!(root(|x| (x > 0.0).then_some(x), (-1.0, 1.0), 1e-9), None);
    assert_eq!(minimum(|_| Some(f64::NAN), (-1.0, 1.0), 1e-9), None);
}

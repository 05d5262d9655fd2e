//! p, alpha and eta of bodies against closed forms and hand calculation.

use rockfrag_core::rocking::{Body, Structure};

fn close(body: Body, [p2, tan_alpha, eta]: [f64; 3]) {
    let found = [body.p_rad_s().powi(2), body.alpha_rad().tan(), body.eta()];
    for (found, expected) in found.into_iter().zip([p2, tan_alpha, eta]) {
        assert!((found - expected).abs() < 1e-6 * expected, "{body:?}: {found}, {expected}");
    }
}

#[test]
fn a_solid_block_is_housners() {
    for (width, height) in [(0.5, 2.0), (0.6, 1.8), (1.1, 1.3)] {
        let block = Structure::rectangular_block("block", width, height, None).unwrap();
        let body = Body::solid(width, height).structure("block", None).unwrap();
        for (found, expected) in
            [(body.p_rad_s, block.p_rad_s), (body.alpha_rad, block.alpha_rad), (body.eta, block.eta)]
        {
            assert!((found / expected - 1.0).abs() < 1e-14, "{width} x {height}: {found}, {expected}");
        }
    }
}

#[test]
fn bodies_have_their_closed_forms() {
    // A cylinder of radius r and height H: I/m about the edge is 5 r^2/4 + H^2/3.
    let (r, h) = (0.25_f64, 1.5_f64);
    let cylinder = Body {
        width_m: 2.0 * r,
        centre_height_m: h / 2.0,
        centre_offset_m: 0.0,
        inertia_m2: (3.0 * r * r + h * h) / 12.0,
    };
    let about_edge = 1.25 * r * r + h * h / 3.0;
    close(cylinder, [9.81 * r.hypot(h / 2.0) / about_edge, 1.0 / 3.0, 1.0 - 2.0 * r * r / about_edge]);
    // 0.6 m wide, 60 kg in the lower 0.4 m and 30 kg in the 1.4 m above: the centre at 0.5 m, I 24.6 kg m2.
    let cabinet = Body { width_m: 0.6, centre_height_m: 0.5, centre_offset_m: 0.0, inertia_m2: 24.6 / 90.0 };
    close(
        cabinet,
        [9.81 * 0.34_f64.sqrt() / (24.6 / 90.0 + 0.34), 0.6, (24.6 / 90.0 + 0.16) / (24.6 / 90.0 + 0.34)],
    );
    // An L of two bars of 1.0 x 0.2 m, one upright at an end of the other: the centre 0.4 m high, 0.3 m from
    // that end.
    let inertia_m2 = 1.04 / 12.0 + 0.13;
    let l = Body { width_m: 1.0, centre_height_m: 0.4, centre_offset_m: -0.2, inertia_m2 };
    let (weak, strong) = (inertia_m2 + 0.25, inertia_m2 + 0.65);
    close(l, [9.81 * 0.5 / weak, 0.75, (inertia_m2 + 0.16 - 0.21) / (weak * strong).sqrt()]);
    // A solid 0.6 x 1.8 m on contacts 0.1 m and 0.3 m from its centre line.
    let inertia_m2 = Body::solid_inertia_m2(0.6, 1.8);
    let off = Body { width_m: 0.4, centre_height_m: 0.9, centre_offset_m: 0.1, inertia_m2 };
    close(off, [2.8163003_f64.powi(2), 0.1 / 0.9, (0.9642857_f64 * 0.9).sqrt()]);
}

#[test]
fn a_body_that_an_impact_stops_is_refused() {
    let flat = Body { width_m: 1.0, centre_height_m: 0.2, centre_offset_m: 0.0, inertia_m2: 0.09 };
    assert_eq!(flat.structure("flat", None).unwrap_err().parameter, "eta");
    assert!(flat.structure("flat", Some(0.8)).is_ok());
}

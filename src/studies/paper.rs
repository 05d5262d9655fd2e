//! Each number that the paper publishes, beside ours.

use std::f64::consts::SQRT_2;

use serde::{Deserialize, Serialize};

use crate::fragility::{CurveFit, DemandFit, DemandModel, Event, Group, Measure};
use crate::fragility::{beta, hybrid_measure, lambda, mu, p_overturning};
use crate::paper::{EXAMPLE_LAMBDA, Published, SeedValue, example, published, seed_values};
use crate::rocking::Structure;
use crate::statistics::normal;

/// A published number beside ours: a row of paper.parquet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "data/columns.csv says it")]
pub struct Comparison {
    pub quantity: String,
    pub place: String,
    pub suite: String,
    pub structure: String,
    pub published: Option<f64>,
    pub ours: Option<f64>,
    /// Mean, standard deviation and number of ours over seeds, of the paper's set-up.
    pub mean: Option<f64>,
    pub sd: Option<f64>,
    pub seeds: i64,
    /// (published - ours) / sd; none where the print leaves open more than two of these sds, ours among it.
    pub z: Option<f64>,
    pub t2: Option<f64>,
    pub t2_p: Option<f64>,
}

/// Compares fits of the paper's structures with all that the paper publishes.
pub fn compare(demand: &[DemandFit], curves: &[CurveFit]) -> Vec<Comparison> {
    let seeds = seed_values();
    let comparison = |number: Published| {
        let ours = ours(&number, demand, curves);
        let Published { quantity, place, suite, structure, .. } = number;
        let is_of_number = |seed: &&SeedValue| {
            (&seed.quantity, &seed.suite, &seed.structure) == (&quantity, &suite, &structure)
        };
        let values: Vec<f64> = seeds.iter().filter(is_of_number).map(|seed| seed.value).collect();
        let n = values.len() as f64;
        let mean = Some(values.iter().sum::<f64>() / n).filter(|_| n > 1.0);
        let sd = mean.map(|mean| (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt());
        let z = || {
            let (ours, sd, low, high) = (ours?, sd?, number.print_low?, number.print_high?);
            let is_open = (low..=high).contains(&ours) && high - low > 2.0 * sd;
            (sd > 0.0 && !is_open).then_some((number.published? - ours) / sd)
        };
        Comparison {
            quantity,
            place,
            suite,
            structure,
            published: number.published,
            ours,
            mean,
            sd,
            seeds: values.len() as i64,
            z: z(),
            t2: number.t2,
            t2_p: number.t2_p,
        }
    };
    published().into_iter().map(comparison).collect()
}

/// Our value of a published quantity; none where the fits do not have it.
fn ours(number: &Published, demand: &[DemandFit], curves: &[CurveFit]) -> Option<f64> {
    let its = Group { suite: Some(&number.suite), structure: &number.structure };
    let plane = |side: &str| {
        let planes = demand.iter().filter(|fit| fit.model == DemandModel::Biplanar);
        let mut on_side = planes.filter(|fit| fit.range_high.is_some() == (side == "low"));
        on_side.find(|fit| fit.group() == its)
    };
    let curve = |structure: &str, im_x: Measure, im_y: Option<Measure>| {
        let mut fitted = curves.iter().filter(|fit| !fit.coefficients.is_empty());
        fitted.find(|fit| {
            fit.group() == Group { structure, ..its }
                && (fit.event, fit.im_x, fit.im_y) == (Event::Overturning, im_x, im_y)
        })
    };
    let im5 = || curve(&number.structure, Measure::Im5, None);
    let hybrid = |structure: &str| curve(structure, Measure::Im4, Some(Measure::Im3Inverse));
    // The hybrid measure of the worked example, of the motion as it meets the structure.
    let of_example = |lambda: f64| {
        let fit = curves.iter().find(|fit| fit.group() == its)?;
        let structure = Structure::new(&fit.structure, fit.p_rad_s, fit.alpha_rad, fit.eta).ok()?;
        let measures = example(&structure);
        Some(hybrid_measure(measures.im4, 1.0 / measures.im3?, lambda))
    };
    // The example takes the curve of the equipment for both structures.
    let equipment = || hybrid("electrical-equipment").map(|curve| &curve.coefficients);
    match number.quantity.as_str() {
        "transition" => plane("high")?.transition_found,
        "r2_pooled" => plane("high")?.r2_pooled,
        "hybrid_lambda" => Some(lambda(&hybrid(&number.structure)?.coefficients).0),
        "im5_theta" => Some(mu(&im5()?.coefficients).0.exp()),
        "im5_beta" => Some(beta(&im5()?.coefficients).0),
        "example_hybrid" => of_example(lambda(equipment()?).0),
        "example_p_ro" => {
            let b = equipment()?;
            Some(p_overturning(of_example(lambda(b).0)?, mu(b).0, beta(b).0))
        }
        // 1/2 (1 + erf(ln IM)): Eq. 24 with mu and beta sqrt 2 left out gives what is printed.
        "example_half_erf" => Some(normal::cdf(SQRT_2 * of_example(EXAMPLE_LAMBDA)?.ln())),
        of_plane => {
            let (side, coefficient) = of_plane.split_once('_')?;
            let fit = plane(side)?;
            match coefficient {
                "r2" => fit.r2,
                name => {
                    fit.coefficients.get(["ln_a", "b1", "b2"].iter().position(|of| *of == name)?).copied()
                }
            }
        }
    }
}

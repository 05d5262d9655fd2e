//! Transforms and normal numbers of ours against those of other libraries.

use rand_distr::{Distribution, StandardNormal};
use realfft::RealFftPlanner;
use rockfrag::motion::fourier::{Transform, even_smooth_at_least};
use rockfrag::random::{Purpose, normals, stream};

#[test]
fn transforms_are_those_of_realfft() {
    let (mut spectrum, mut scratch) = (Vec::new(), Vec::new());
    let mut lengths: Vec<usize> = (1..=300).map(even_smooth_at_least).collect();
    lengths.extend([4050, 4096, 4374, 6250, 8000, 8192, 12_288, 15_625 * 2, 65_536, 2 * 59_049]);
    lengths.dedup();
    for length in lengths {
        let samples: Vec<f64> = normals(stream(7, Purpose::Noise, length as u64)).take(length).collect();
        let plan = RealFftPlanner::<f64>::new().plan_fft_forward(length);
        let mut theirs = plan.make_output_vec();
        plan.process(&mut samples.clone(), &mut theirs).unwrap();
        let transform = Transform::new(length);
        let mut back = samples.clone();
        transform.forward(&mut back, &mut spectrum, &mut scratch);
        assert_eq!(spectrum.len(), theirs.len());
        let limit = 1e-15 * (length as f64).sqrt() * (length as f64).log2().max(1.0);
        for (ours, theirs) in spectrum.iter().zip(&theirs) {
            assert!((ours - theirs).norm() <= limit, "{length}: {ours} for {theirs}");
        }
        transform.inverse(&mut spectrum, &mut back, &mut scratch);
        for (back, sample) in back.iter().zip(&samples) {
            assert!((back - sample).abs() <= 1e-14, "{length}: {back} for {sample}");
        }
    }
}

#[test]
fn normal_numbers_are_those_of_rand_distr() {
    // Some hundred of a million are from the tail, some ten thousand from the edges of layers.
    for row in 0..4 {
        let theirs = Distribution::<f64>::sample_iter(StandardNormal, stream(1, Purpose::Noise, row));
        for (ours, theirs) in normals(stream(1, Purpose::Noise, row)).zip(theirs).take(1_000_000) {
            assert!((ours - theirs).abs() <= 1e-13, "{ours} for {theirs}");
        }
    }
}

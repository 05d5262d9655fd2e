//! Pairs of horizontal components: one event and station, at right angles.

use std::collections::HashMap;

use super::RecordedMotion;
use super::rotation::HorizontalPair;

/// Pairs each component with the first free earlier one of its event, station and time step at right angles;
/// `T` identifies a component. Returns the pairs in the order of their first components, and the components
/// left out: vertical, of unknown origin, or without a partner.
pub fn pairs<T>(components: Vec<(RecordedMotion, T)>) -> (Vec<[T; 2]>, Vec<T>) {
    let mut waiting: HashMap<_, Vec<(usize, f64)>> = HashMap::new();
    let mut found = Vec::new();
    for (place, (motion, _)) in components.iter().enumerate() {
        let is_known = motion.event.is_some() || motion.station.is_some();
        let Some(azimuth_deg) = motion.azimuth_deg.filter(|_| is_known) else { continue };
        let others = waiting.entry((&motion.event, &motion.station, motion.dt_s.to_bits())).or_default();
        match others.iter().position(|(_, other)| HorizontalPair::is_right_angle(*other, azimuth_deg)) {
            Some(at) => found.push([others.remove(at).0, place]),
            None => others.push((place, azimuth_deg)),
        }
    }
    found.sort_unstable();
    let mut left: Vec<Option<T>> = components.into_iter().map(|(_, component)| Some(component)).collect();
    let both = |[first, second]: [usize; 2]| Some([left[first].take()?, left[second].take()?]);
    let pairs = found.into_iter().filter_map(both).collect();
    (pairs, left.into_iter().flatten().collect())
}

//! Which horizontal components belong together: those of one event and station at right angles.

use std::collections::HashMap;

use super::RecordedMotion;
use super::rotation::HorizontalPair;

/// Event, station, and the bits of the time step.
type Place = (Option<String>, Option<String>, u64);

/// A component that has no partner yet.
struct Waiting<T> {
    /// Place in the order of all components.
    order: usize,
    azimuth_deg: f64,
    component: T,
}

/// A search for pairs among components of which only what `T` says is kept.
pub struct PairSearch<T> {
    components: usize,
    waiting: HashMap<Place, Vec<Waiting<T>>>,
    /// Pairs with the place of their first component in the order of all.
    pairs: Vec<(usize, [T; 2])>,
    left_out: Vec<T>,
}

/// The outcome of a search for pairs.
pub struct Pairs<T> {
    /// In the order of their first components.
    pub pairs: Vec<[T; 2]>,
    /// Components that are vertical, of unknown place, or without a partner.
    pub left_out: Vec<T>,
}

impl<T> Default for PairSearch<T> {
    fn default() -> PairSearch<T> {
        PairSearch { components: 0, waiting: HashMap::new(), pairs: Vec::new(), left_out: Vec::new() }
    }
}

impl<T> PairSearch<T> {
    /// Adds a component, which pairs with the first one that waits for it.
    pub fn add(&mut self, motion: RecordedMotion, component: T) {
        self.components += 1;
        let is_known = motion.event.is_some() || motion.station.is_some();
        let Some(azimuth_deg) = motion.azimuth_deg.filter(|_| is_known) else {
            return self.left_out.push(component);
        };
        let place = (motion.event, motion.station, motion.dt_s.to_bits());
        let others = self.waiting.entry(place).or_default();
        let is_partner = |other: &Waiting<T>| HorizontalPair::is_right_angle(other.azimuth_deg, azimuth_deg);
        match others.iter().position(is_partner) {
            Some(at) => {
                let first = others.remove(at);
                self.pairs.push((first.order, [first.component, component]));
            }
            None => others.push(Waiting { order: self.components, azimuth_deg, component }),
        }
    }

    pub fn finish(mut self) -> Pairs<T> {
        self.pairs.sort_by_key(|(first, _)| *first);
        let mut alone: Vec<_> = self.waiting.into_values().flatten().collect();
        alone.sort_by_key(|waiting| waiting.order);
        self.left_out.extend(alone.into_iter().map(|waiting| waiting.component));
        Pairs { pairs: self.pairs.into_iter().map(|(_, pair)| pair).collect(), left_out: self.left_out }
    }
}

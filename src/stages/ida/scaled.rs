//! All structures under some motions, at all intensities of the scan.

use std::path::Path;

use super::Ida;
use crate::motion::{IntensityMeasures, IntensityScratch};
use crate::rocking::{
    Problem, Record, RecordError, Response, ScanPoint, ScanResponse, Structure, simulate_all,
};
use crate::stages::shared::motions::{Peaks, record};
use crate::table::TableError;
use crate::table::ida::{CapacityRow, StripeRow};
use crate::table::motions::Motion;
use crate::table::schema;

/// Scaled samples that are held at once, or those of one motion.
const MOST_SAMPLES: usize = 1 << 20;

/// A structure under a motion.
struct Case<'m, 's> {
    /// The file of the motion.
    path: &'m Path,
    motion: &'m Motion,
    samples: &'s [f64],
    peaks: Peaks,
    structure: &'m Structure,
    /// The measure of the motion as it is.
    unscaled: f64,
}

impl Ida {
    /// The stripes and the capacity of each structure under each of some motions, in order.
    pub(super) fn stripes_and_capacities<'a>(
        &'a self,
        path: &'a Path,
        motions: &'a [Motion],
        scratch: &mut IntensityScratch,
    ) -> anyhow::Result<(Vec<StripeRow<'a>>, Vec<CapacityRow<'a>>)> {
        let samples: Vec<Vec<f64>> = motions.iter().map(|motion| motion.acceleration_m_s2.to_vec()).collect();
        let mut cases = Vec::new();
        for (motion, samples) in motions.iter().zip(&samples) {
            let peaks = Peaks::of(motion, &record(path, motion, samples)?, scratch);
            for structure in &self.structures {
                let unscaled = self.unscaled(path, motion, &peaks, structure)?;
                cases.push(Case { path, motion, samples, peaks, structure, unscaled });
            }
        }
        let scans = self.scan.run(cases.len(), |points| self.respond(&cases, points))?;
        let (mut stripes, mut capacities) = (Vec::new(), Vec::new());
        for (case, responses) in cases.iter().zip(&scans) {
            let is_level = |response: &&ScanResponse| {
                let levels = self.scan.levels();
                levels.binary_search_by(|level| level.total_cmp(&response.intensity)).is_ok()
            };
            let shares = self.scan.overturning_shares(responses).into_iter().map(Some).chain([None]);
            let levels = responses.iter().filter(is_level).zip(shares);
            stripes.extend(levels.map(|(response, share)| self.stripe(case, response, share)));
            capacities.push(CapacityRow {
                motion_id: &case.motion.motion_id,
                suite: case.motion.suite.as_deref(),
                structure: case.structure,
                measure: self.measure(),
                unscaled: case.unscaled,
                capacity: self.scan.capacity(responses),
            });
        }
        Ok((stripes, capacities))
    }

    fn unscaled(
        &self,
        path: &Path,
        motion: &Motion,
        peaks: &Peaks,
        structure: &Structure,
    ) -> Result<f64, TableError> {
        let measures =
            IntensityMeasures::new(structure, peaks.pga_m_s2, peaks.pgv_m_s, motion.tp_s, peaks.tm_s);
        self.options.measure.0.unscaled(peaks, &measures).ok_or_else(|| {
            let (id, measure) = (&motion.motion_id, self.measure());
            let problem = format!(
                "motion '{id}' has no {measure} above 0 that could be scaled; leave it out, or take --measure scale"
            );
            value_error(path, motion, problem)
        })
    }

    /// Simulates scaled copies of the samples, as many at once as fit.
    fn respond(&self, cases: &[Case], points: &[ScanPoint]) -> Result<Vec<Response>, TableError> {
        let mut responses = Vec::with_capacity(points.len());
        let mut rest = points;
        while !rest.is_empty() {
            let (block, later) =
                rest.split_at(block(rest.iter().map(|point| cases[point.case].samples.len())));
            let scaled: Vec<Vec<f64>> = block.iter().map(|point| cases[point.case].scaled(point)).collect();
            let problems = block.iter().zip(&scaled).map(|(point, samples)| {
                let Case { path, structure, motion, .. } = &cases[point.case];
                let refused = |problem: RecordError| {
                    let id = &motion.motion_id;
                    let problem = format!(
                        "motion '{id}', scaled: {problem}; correct it, or scale less by a lower --to"
                    );
                    value_error(path, motion, problem)
                };
                Ok(Problem { structure, record: Record::new(samples, motion.dt_s).map_err(refused)? })
            });
            let problems = problems.collect::<Result<Vec<Problem>, TableError>>()?;
            responses.extend(simulate_all(&problems, self.simd));
            rest = later;
        }
        Ok(responses)
    }

    fn stripe<'m>(
        &self,
        case: &Case<'m, '_>,
        at: &ScanResponse,
        overturning_above: Option<f64>,
    ) -> StripeRow<'m> {
        let Case { motion, structure, .. } = case;
        let scale = at.intensity / case.unscaled;
        StripeRow {
            response: case.peaks.scaled(scale).response_row(motion, structure, at.response),
            measure: self.measure(),
            intensity: at.intensity,
            scale,
            overturning_above,
        }
    }
}

impl Case<'_, '_> {
    fn scaled(&self, point: &ScanPoint) -> Vec<f64> {
        let factor = point.intensity / self.unscaled;
        self.samples.iter().map(|sample| factor * sample).collect()
    }
}

/// How many of the records of these lengths are held at once.
fn block(lengths: impl Iterator<Item = usize>) -> usize {
    let mut samples = 0;
    let fits = lengths.take_while(|length| {
        samples += length;
        samples <= MOST_SAMPLES
    });
    fits.count().max(1)
}

fn value_error(path: &Path, motion: &Motion, problem: String) -> TableError {
    let column = schema::acceleration_m_s2.name.to_string();
    TableError::Value { path: path.to_path_buf(), row: motion.row, column, problem }
}

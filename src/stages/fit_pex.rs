//! fit-pex: regressions of the demand in safe rocking.

use std::str::FromStr;

use clap::Args;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Value, json};

use super::shared::groups;
use super::shared::uncertainty::{LIMIT_STATE, uncertainty};
use super::simulate::Simulate;
use crate::fragility::CaseTable;
use crate::fragility::demand::{Regression, RegressionOptions, ScanPoint};
use crate::keyword::Keyword;
use crate::pipeline::console::{Console, OfGroup};
use crate::pipeline::declare::{Declare, Files, Input, Output, StageOptions};
use crate::pipeline::options::{check, check_bound, defaults, from_scalar};
use crate::pipeline::stage::Stage;
use crate::statistics::FitStatus;
use crate::table::pex::{GroupRegression, PEX, PEX_BOOTSTRAP, PexReplicateRow, PexRow, ScanRow};
use crate::table::row::WriteRow;
use crate::table::store::provenance::Provenance;
use crate::table::store::source::{Source, Target};
use crate::table::store::writer::TableWriter;

/// How the demand is fitted.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct FitPexOptions {
    /// Limit state of P_ex: a demand |theta|max / alpha
    #[arg(long, default_value = "0.10", value_name = "DEMAND")]
    pub limit_state: f64,
    /// IM4 at which the two planes meet: a number, or found (where the pooled residual is least)
    #[arg(long, default_value = "found", value_name = "IM4")]
    pub transition: TransitionAt,
    /// Raise smaller demands in safe rocking to this one, as a solver of finite tolerance does [default: none]
    #[arg(long, value_name = "DEMAND")]
    pub demand_floor: Option<f64>,
    /// Number of bootstrap resamples, drawn within each cell of magnitude and distance
    #[arg(long, default_value = "0", value_name = "N")]
    pub bootstrap: usize,
    /// Confidence level of all limits
    #[arg(long, default_value = "0.95", value_name = "P")]
    pub confidence: f64,
    /// Seed of the resamples [default: 42]
    #[arg(long)]
    pub seed: Option<u64>,
}

impl Default for FitPexOptions {
    fn default() -> Self {
        defaults()
    }
}

impl StageOptions for FitPexOptions {
    fn seed(&mut self) -> Option<&mut Option<u64>> {
        Some(&mut self.seed)
    }
}

/// Where the two planes meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TransitionAt {
    /// Where their pooled residual is least.
    Found,
    /// At this IM4.
    Fixed(f64),
}

impl TransitionAt {
    /// The IM4 that is fixed, if one is.
    pub fn im4(self) -> Option<f64> {
        match self {
            TransitionAt::Found => None,
            TransitionAt::Fixed(im4) => Some(im4),
        }
    }
}

impl FromStr for TransitionAt {
    type Err = String;

    fn from_str(text: &str) -> Result<TransitionAt, String> {
        match (text, text.parse()) {
            ("found", _) => Ok(TransitionAt::Found),
            (_, Ok(im4)) if im4 > 1.0 && im4 < 100.0 => Ok(TransitionAt::Fixed(im4)),
            _ => Err(format!("'{text}': expected 'found' or an IM4 above 1")),
        }
    }
}

impl Serialize for TransitionAt {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            TransitionAt::Found => serializer.serialize_str("found"),
            TransitionAt::Fixed(im4) => serializer.serialize_f64(*im4),
        }
    }
}

impl<'de> Deserialize<'de> for TransitionAt {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<TransitionAt, D::Error> {
        from_scalar(deserializer)
    }
}

/// The stage, ready to run.
pub struct FitPex {
    options: FitPexOptions,
    regressions: RegressionOptions,
    input: Source,
    out: Target,
}

impl FitPex {
    /// Of the responses in `input`, into `out`.
    ///
    /// # Errors
    /// If an option is out of range.
    pub fn new(
        options: &FitPexOptions,
        input: impl Into<Source>,
        out: impl Into<Target>,
    ) -> anyhow::Result<FitPex> {
        let limit = options.limit_state;
        check_bound(&LIMIT_STATE, limit)?;
        if let Some(floor) = options.demand_floor {
            check(
                floor > 0.0 && floor < limit,
                "demand-floor",
                floor,
                "a demand above 0 and below the limit state",
            )?;
        }
        let transition = options.transition.im4();
        let uncertainty = uncertainty(options.bootstrap, options.confidence, options.seed)?;
        let options = FitPexOptions { seed: Some(uncertainty.seed), ..options.clone() };
        let regressions = RegressionOptions { transition, limit, uncertainty };
        Ok(FitPex { options, regressions, input: input.into(), out: out.into() })
    }

    fn scan_target(&self) -> Target {
        self.out.part("scan")
    }

    fn bootstrap_target(&self) -> Option<Target> {
        (self.options.bootstrap > 0).then(|| self.out.part("bootstrap"))
    }
}

impl Declare for FitPex {
    type Options = FitPexOptions;
    const NAME: &'static str = PEX.stage;
    const ABOUT: &'static str = "Fit the demand in safe rocking: P_ex";
    const EXAMPLES: &'static str = "rockfrag fit-pex --transition 1.3\n\
        rockfrag fit-pex --limit-state 0.2 --bootstrap 200 --out wider.parquet";
    const INPUTS: &'static [Input] =
        &[Input::file("responses", "in", Simulate::OUTPUT.file, "Responses to read")];
    const OUTPUT: Output =
        Output::file("pex.parquet", "Fits to write [default: pex.parquet beside the input]")
            .with_parts(&["scan", "bootstrap"]);

    fn create(options: &FitPexOptions, files: &Files) -> anyhow::Result<FitPex> {
        FitPex::new(options, files.input("responses")?, files.out(Self::OUTPUT.file)?)
    }
}

impl Stage for FitPex {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        vec![("responses", self.input.clone())]
    }

    fn targets(&self) -> Vec<Target> {
        [self.scan_target()].into_iter().chain(self.bootstrap_target()).chain([self.out.clone()]).collect()
    }

    fn parameters(&self) -> Value {
        json!(self.options)
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let floor = self.options.demand_floor.unwrap_or(0.0);
        let groups = groups::read_each(&self.input, |_, row| {
            if row.case().has_demand() {
                row.edp = row.edp.map(|edp| edp.max(floor));
            }
        })?;
        let steps = groups.len() as u64 * self.regressions.uncertainty.steps();
        let bar = console.bar(self.name(), steps);
        let to_fit: Vec<&CaseTable> = groups.iter().map(|group| &group.cases).collect();
        let fitted = self.regressions.fit(&to_fit, &|steps| bar.inc(steps))?;
        bar.finish();
        let (mut rows, mut scans) = (Vec::new(), Vec::new());
        for (group, fitted) in groups.iter().zip(fitted) {
            let row = |regression| GroupRegression {
                suite: group.suite.clone(),
                structure: group.structure.clone(),
                eta: group.eta,
                block: group.block(),
                limit_state: self.options.limit_state,
                regression,
            };
            let scan = |point: ScanPoint| ScanRow {
                suite: group.suite.clone(),
                structure: group.structure.clone(),
                transition: point.im4,
                pooled_rss: point.pooled_rss,
                n_low: point.n_low,
                n_high: point.n_high,
            };
            rows.extend(fitted.fits.into_iter().map(row));
            scans.extend(fitted.scan.into_iter().map(scan));
        }
        let missing = rows.iter().filter(|row| row.regression.status() != FitStatus::Ok);
        console.warn_each_group(missing.map(|row| (reason(row), measures(&row.regression))));
        let fitted = rows.iter().filter(|row| row.regression.status() == FitStatus::Ok).count();
        if fitted == 0 {
            console.warn(&format!(
                "none of {} regressions can be fitted; expected more cases that rock and do not overturn: more motions, or a structure \
                 that rocks in them",
                rows.len()
            ));
        }
        ScanRow::write(&scans, self.scan_target(), provenance)?;
        if let Some(target) = self.bootstrap_target() {
            let mut writer = TableWriter::create(target, &PEX_BOOTSTRAP, provenance.clone())?;
            for row in &rows {
                writer.append(&PexReplicateRow::batch(&row.replicates().collect::<Vec<_>>())?)?;
            }
            writer.finish()?;
        }
        PexRow::write(&rows.iter().map(PexRow::from).collect::<Vec<_>>(), self.out.clone(), provenance)?;
        let status = FitStatus::Ok.as_str();
        Ok(format!("{fitted} of {} fits {status}", rows.len()))
    }
}

/// The form and the measure of a regression, for a message.
fn measures(regression: &Regression) -> String {
    format!("{} {}", regression.form.as_str(), regression.im_x.as_str())
}

/// What is wrong with a regression, for a message.
fn reason(GroupRegression { suite, structure, regression, .. }: &GroupRegression) -> OfGroup {
    let suite = suite.as_deref().unwrap_or("the motions");
    let words = match regression.status() {
        FitStatus::Falling => "the demand for {}, falls with the measure".to_string(),
        status => format!("no fit of the demand for {{}}: {}", status.as_str()),
    };
    OfGroup { words, group: format!("{suite}, {structure}"), counts: String::new() }
}

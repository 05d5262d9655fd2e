//! The stages: one file or folder a subcommand, which reads tables, calls the science and writes tables.

pub mod init;
pub mod inspect;
pub mod run;
pub mod shared;

use clap::Subcommand;

use crate::pipeline::Stage;

/// Declares the stages, in the order of a run: the file and the struct of each.
macro_rules! stages {
    ($($module:ident :: $stage:ident),* $(,)?) => {
        $(pub mod $module;)*

        /// All stages.
        #[derive(Debug, Subcommand)]
        #[expect(clippy::large_enum_variant, reason = "clap makes one for each call")]
        pub enum Stages {
            $($stage($module::$stage)),*
        }

        impl Stages {
            /// The stage that clap has parsed.
            pub fn parsed(self) -> Box<dyn Stage> {
                match self {
                    $(Stages::$stage(stage) => Box::new(stage)),*
                }
            }
        }
    };
}

stages! {
    sample_scenarios::SampleScenarios,
    synthesize_motions::SynthesizeMotions,
    import_motions::ImportMotions,
    floor_motions::FloorMotions,
    simulate::Simulate,
    ida::Ida,
    fit_pex::FitPex,
    fit_pro::FitPro,
    compare_paper::ComparePaper,
    rank_ims::RankIms,
    evaluate::Evaluate,
    export::Export,
    validate::Validate,
    report::Report,
}

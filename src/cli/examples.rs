//! The examples of each command, at the end of its help. `-h` shows the options that they use, `--help` all.

use clap::Command;

/// Commands and their examples, at most ten options each.
const EXAMPLES: [(&str, &str); 14] = [
    (
        "sample-scenarios",
        "rockfrag sample-scenarios
rockfrag sample-scenarios --mw 6:7:0.5 --re 5,10,20 --samples 200 --seed 7 --out scenarios.parquet",
    ),
    (
        "synthesize-motions",
        "rockfrag synthesize-motions
rockfrag synthesize-motions --in scenarios.parquet --suite csgm --dt 0.01 --site soil --seed 7 --out motions.parquet
rockfrag synthesize-motions --sa 0.2,1.0 --partition 0/8",
    ),
    (
        "import-motions",
        "rockfrag import-motions records --about records.csv --out motions.parquet
rockfrag import-motions a.csv b.csv --unit g --dt 0.01 --column 2
rockfrag import-motions records --keep-going --scale 0.5,1,2 --rotate strongest-pulse",
    ),
    ("floor-motions", "rockfrag floor-motions --in motions.parquet --period 0.6 --level 0.5 --out floor.parquet"),
    (
        "simulate",
        "rockfrag simulate
rockfrag simulate --in motions.parquet --width 0.5 --height 1.9 --out responses.parquet
rockfrag simulate --structures objects.csv --trace all
rockfrag simulate --structure name=frame,p=1,alpha=0.15,eta=0.92 --partition 0/8",
    ),
    (
        "ida",
        "rockfrag ida --in motions.parquet --width 0.5 --height 1.9 --measure pga --from 0.1 --to 3 --out ida.parquet
rockfrag ida --structures objects.csv",
    ),
    ("fit-pex", "rockfrag fit-pex\nrockfrag fit-pex --in responses.parquet --limit-state 0.1,0.5 --all --out fits/pex.parquet"),
    ("fit-pro", "rockfrag fit-pro\nrockfrag fit-pro --in responses.parquet --pairs im4:im5 --all --out fits/pro.parquet"),
    ("compare-paper", "rockfrag compare-paper\nrockfrag compare-paper --pex fits/pex.parquet --pro fits/pro.parquet --all --out paper.parquet"),
    (
        "rank-ims",
        "rockfrag rank-ims --in responses.parquet --terms 1 --out ranking.parquet
rockfrag rank-ims --motions motions.parquet --candidate energy_m",
    ),
    (
        "evaluate",
        "rockfrag evaluate --width 0.5 --height 2.0
rockfrag evaluate --width 0.5 --height 2.0 --pga 0.5 --pgv 0.6
rockfrag evaluate --width 0.5 --height 2.0 --depth 0.4 --hazard pga.csv,sa.csv
rockfrag evaluate --structures objects.csv --hazard pga.csv --out objects.parquet
rockfrag evaluate --width 0.5 --height 2.0 --period 0.6 --level 0.5 --hazard pga.csv",
    ),
    (
        "export",
        "rockfrag export --width 0.5 --height 1.9 --to openquake --out cabinet.xml
rockfrag export --structures objects.csv --to pelicun --im pga --fits fits --suite csgm",
    ),
    ("validate", "rockfrag validate --in responses.parquet --fits fits --name frame --suite csgm --out validation.parquet"),
    ("report", "rockfrag report --in out --title \"Server room\" --author \"A. Engineer\" --out report.html"),
];

/// Adds the examples of a command, and leaves the options that they do not use to `--help`.
pub fn with_examples(command: Command) -> Command {
    let Some((_, examples)) = EXAMPLES.iter().find(|(name, _)| *name == command.get_name()) else {
        return command;
    };
    let words: Vec<&str> = examples.split_whitespace().collect();
    let is_used = |flag: Option<&str>| flag.is_none_or(|flag| words.contains(&&*format!("--{flag}")));
    command.after_help(*examples).mut_args(|arg| {
        let is_hidden = !is_used(arg.get_long());
        arg.hide_short_help(is_hidden)
    })
}

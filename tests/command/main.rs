//! The program as users run it: exit codes, what errors name, files and caching. No test asserts a sentence.

mod common;
mod config;
mod evaluate;
mod files;
mod fits;
mod floors;
mod foreign;
mod hazard;
mod interruption;
mod keys;
mod objects;
mod outcomes;
#[path = "../inputs/packed.rs"]
mod packed;
mod paper;
mod pipeline;
mod records;
mod tables;
mod terminal;

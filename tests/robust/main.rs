//! What is thrown at rockfrag to break it. What draws its cases by chance draws more of them with PROPTEST_CASES=100000.

#![cfg(feature = "pipeline")]

mod bombs;
mod configs;
mod damage;
mod importers;
mod lists;
mod readers;
mod replaced;
mod row_groups;
mod versions;

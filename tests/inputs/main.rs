//! Files as people and agencies bring them: bytes, tables, numbers, headings.

mod bytes;
mod grid;
mod hazard;
mod objects;
mod packed;

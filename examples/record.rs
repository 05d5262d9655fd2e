//! The response of a block over time to a record in a file of AT2, COSMOS, ESM, K-NET or CSV.

use rockfrag::inputs::records::{ReadOptions, read_records};
use rockfrag_core::rocking::{Outcome, Record, Structure, trace};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("expected the file of a record")?;
    let motions = read_records(&std::fs::read(path)?, &ReadOptions::default())?;
    let motion = motions.first().ok_or("no record in the file")?;
    let record = Record::new(&motion.acceleration_m_s2, motion.dt_s)?;

    let block = Structure::rectangular_block("block", 0.5, 2.0, None)?;
    // Ten seconds of still ground show how it comes to rest.
    let (response, points) = trace(&block, &record, 10.0);
    println!("time_s,theta_over_alpha,event");
    for point in &points {
        let event = point.solver_event.map_or(String::new(), |event| event.to_string());
        println!("{:.3},{:.5},{event}", point.time_s, point.theta_rad / block.alpha_rad);
    }
    match response.outcome {
        Outcome::NoRocking => eprintln!("stays on its base"),
        Outcome::SafeRocking(demand) => eprintln!("rocks, |theta|max / alpha {demand:.3}"),
        Outcome::Overturned => eprintln!("overturns"),
    }
    Ok(())
}

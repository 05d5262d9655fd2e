//! What would change an object, one thing at a time.

use rockfrag_core::hazard::Site;
use rockfrag_core::object::Object;

use super::{Answer, ModelsOf, Question};

/// The answers for an object at a site: as it is; with a wider base, a lower centre of mass, on another floor;
/// with a restitution as a test may find it. What would not rock, or lies outside the model, has none.
pub fn variants(object: &Object, site: &Site, years: f64, models: ModelsOf) -> Vec<Answer> {
    let question = Question::Hazard { site: site.clone(), years, target: None };
    let as_it_is = ("as it is".to_string(), object.clone());
    let changes = object.changes().into_iter().map(|changed| (changed.words, changed.object));
    let all = std::iter::once(as_it_is).chain(changes).filter_map(|(words, object)| {
        let (answer, _) = Answer::new(&object, &question, models).ok()?;
        let answer = Some(answer).filter(Answer::is_answered)?;
        Some(Answer { variant: Some(words), ..answer })
    });
    all.collect()
}

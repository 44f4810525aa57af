//! Features that bring the objects which a device has just as a library defines them.

use std::collections::BTreeSet;

use od_spec::model::Index;
use od_spec::order::Arrange as _;
use od_spec::{Feature, Library};

/// Features, and the objects that they bring.
#[derive(Default)]
pub(super) struct Chosen {
    pub features: Vec<String>,
    pub objects: BTreeSet<Index>,
}

/// Chooses features of a library whose objects are all exactly there, the largest first; none that would bring nothing new. What
/// every device has is brought in any case.
pub(super) fn choose(library: &Library, exact: &BTreeSet<Index>, chosen: &mut Chosen) {
    let implied = library.features.iter().filter(|feature| feature.implied);
    chosen.objects.extend(implied.flat_map(|feature| &feature.objects).filter(|index| exact.contains(index)));
    let mut candidates: Vec<(BTreeSet<Index>, &Feature)> = library
        .features
        .iter()
        .filter(|feature| !feature.implied && !feature.is_counted)
        .filter_map(|feature| Some((brought(library, feature)?, feature)))
        .filter(|(objects, _)| objects.is_subset(exact))
        .collect();
    candidates.arrange_by_key(|(objects, _)| std::cmp::Reverse(objects.len()));
    let mut taken: BTreeSet<&str> = BTreeSet::new();
    for (objects, feature) in candidates {
        if !objects.is_subset(&chosen.objects) {
            chosen.objects.extend(objects);
            taken.insert(&feature.name);
        }
    }
    // In the order of the library.
    let order = library.features.iter().filter(|feature| taken.contains(feature.name.as_str()));
    chosen.features.extend(order.map(|feature| feature.name.clone()));
}

/// The objects that a feature brings with those that it needs; `None` where a need is unknown.
fn brought(library: &Library, feature: &Feature) -> Option<BTreeSet<Index>> {
    let (mut objects, mut open, mut seen) = (BTreeSet::new(), vec![feature], BTreeSet::new());
    while let Some(feature) = open.pop() {
        if seen.insert(&feature.name) {
            objects.extend(&feature.objects);
            for need in &feature.needs {
                open.push(library.features.iter().find(|one| one.name == *need)?);
            }
        }
    }
    Some(objects)
}

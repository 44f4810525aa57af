//! Numbers of the format.

use od_spec::model::Ratio;

/// A fraction as a decimal: exact where there is one, and else the nearest number of 64 bits, which is what tools reckon with.
pub(super) fn decimal(ratio: Ratio) -> String {
    if let Some(exact) = exact(ratio) {
        return exact;
    }
    let [numerator, denominator] = [ratio.numerator(), ratio.denominator()].map(nearest);
    (numerator / denominator).to_string()
}

/// Whether [`decimal`] is the fraction itself.
pub(super) fn is_exact(ratio: Ratio) -> bool {
    exact(ratio).is_some()
}

/// Most decimal places that are written: those of 1/2^32, and some.
const MOST_PLACES: usize = 36;

fn exact(ratio: Ratio) -> Option<String> {
    let text = (0..=MOST_PLACES).find_map(|places| ratio.to_decimal(places))?;
    Some(text)
}

#[expect(clippy::cast_precision_loss, reason = "the nearest number is wanted")]
fn nearest(whole: i128) -> f64 {
    whole as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decimal_is_exact_where_there_is_one() {
        for (numerator, denominator, expected, is_the_same) in [
            (1, 1, "1", true),
            (1, 10, "0.1", true),
            (-40, 1, "-40", true),
            (360, 65_536, "0.0054931640625", true),
            (1, 4_294_967_296, "0.00000000023283064365386962890625", true),
            (1, 3, "0.3333333333333333", false),
            (-2, 3, "-0.6666666666666666", false),
        ] {
            let ratio = Ratio::new(numerator, denominator).unwrap();
            assert_eq!((decimal(ratio).as_str(), is_exact(ratio)), (expected, is_the_same));
        }
    }
}

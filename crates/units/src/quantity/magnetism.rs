//! What a compass needle feels.

use super::Scale;
use super::define::{linear_quantity, quantity, vector_quantity};

vector_quantity! {
    /// A magnetic flux density or one component of it, inside in teslas.
    ///
    /// The Earth's is 25 to 65 uT.
    MagneticField = "a magnetic field" {
        "T": Scale::ONE => from_teslas, teslas;
        "mT": Scale::over(1e3);
        "uT": Scale::over(1e6) => from_microteslas, microteslas;
        "nT": Scale::over(1e9) => from_nanoteslas, nanoteslas;
        "G": Scale::over(1e4) => from_gauss, gauss;
        "mG": Scale::over(1e7);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_worth_what_they_should() {
        assert_eq!("0.5 G".parse(), Ok(MagneticField::from_microteslas(50.0)));
        assert_eq!(
            "48000 nT".parse(),
            Ok(MagneticField::from_microteslas(48.0))
        );
    }
}

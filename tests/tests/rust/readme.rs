//! The firmware in the README does what it says.

mod fragment {
    include!("../../readme/firmware.rs");

    #[test]
    fn the_fragment_takes_a_set_point_and_sends_a_pressure() {
        let mut od = Valve::new(3);
        let mut hardware = Hardware { set_point: od.set_pressure() };
        assert_eq!(hardware.set_point, Decibar(25));
        let sent = cycle(&mut od, &mut hardware, &[120, 0], 118).expect("both PDOs are valid");
        assert_eq!(*sent, [118, 0]);
        assert_eq!(hardware.set_point, Decibar(120));
        // 16.1 bar is refused, and the set-point stays.
        assert!(cycle(&mut od, &mut hardware, &[161, 0], 119).is_some());
        assert_eq!(hardware.set_point, Decibar(120));
        assert_eq!(od.actual_pressure(), Special::Value(Decibar(119)));
        assert_eq!(format!("{:?}", hardware.set_point), "12.0 bar");
        assert_eq!(od.set_pressure(), Decibar(120));
    }
}

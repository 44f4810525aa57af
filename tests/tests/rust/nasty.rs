//! Unusual specifications give code that compiles without a warning and does what they say.

use firmware_glue::{AbortCode, Constrained, Dictionary, EntryId, pdo};

#[deny(warnings)]
mod dictionary {
    od_macros::object_dictionary!("shared/nasty.od.yaml");
}

use dictionary::{Entry, Nasty, machines, types};

#[test]
fn odd_widths_are_computed_with_a_sign() {
    let mut od = Nasty::new(1);
    assert!(od.broken_constraint().is_none());
    // 0 - 5 is below 100, whatever the width.
    assert_eq!(od.write_consistent(0x2000, 0, &[0, 0, 0], &mut ()), Ok(Entry::A));
    assert_eq!(od.write_consistent(0x2000, 0, &[106, 0, 0], &mut ()), Err(AbortCode::INCOMPATIBLE));
    assert_eq!(od.write_consistent(0x2000, 0, &[105, 0, 0], &mut ()), Ok(Entry::A));
    assert_eq!(od.narrow().0, 0xFF_FFFF);
    assert_eq!(od.set_narrow(dictionary::units::U(7)), Ok(()));
    assert_eq!(od.wide().0, 7);
    assert_eq!(od.odd(), types::OddEnum::ON);
    assert_eq!(od.outcome(), types::Result::ERR);
    assert_eq!(format!("{:?} {:?}", od.odd(), od.outcome()), "odd enum: on (16777215) result: err (-1)");
}

#[test]
fn a_bit_field_on_a_signed_number_shows_its_bits() {
    let mut od = Nasty::new(1);
    assert_eq!(od.word_view().0, 0xFFFF);
    assert_eq!(*od.read(0x2003, 0).unwrap(), [0xFF, 0xFF]);
    assert!(od.word_view().last());
    od.set_word(5);
    assert_eq!(od.set_word_view(types::SignedBits(0xFFFE)), Ok(()));
    assert_eq!(od.word(), -2);
    od.write(0x2003, 0, &[0xFD, 0xFF], &mut ()).unwrap();
    assert_eq!(od.word(), -3);
}

#[test]
fn what_is_written_by_name_or_counted_from_elsewhere_is_code() {
    let mut od = Nasty::new(1);
    assert_eq!((od.last_bit().0, od.f32()), (0x8000, -0.0));
    assert_eq!(
        od.write(0x2019, 0, &f32::from_bits(0x8000_0002).to_le_bytes(), &mut ()),
        Err(AbortCode::TOO_LOW)
    );
    assert_eq!(od.above().to_string(), "1 × 1/3 + -1/7 w");
    assert_eq!(od.above_view().to_string(), "0 × 1/1 + -1/7 w");
    od.set_above(dictionary::units::W(0xFF_FFFF_FFFF)).unwrap();
    assert_eq!(od.above_view().0, u32::MAX);
    // -1/7 is below -0.1, and 1/3 - 1/7 above it.
    for (huge, word, broken) in [(1, -1, None), (0, -1, Some("super")), (1, -2, Some("super"))] {
        od.set_huge(dictionary::units::W(huge));
        od.set_word(word);
        assert_eq!(od.broken_constraint().map(|constraint| constraint.name), broken, "{huge} {word}");
    }
    od.set_word(-1);
    od.set_huge(dictionary::units::W(1));
    od.set_last_bit(types::SignedBits(0));
    assert_eq!(od.broken_constraint().map(|constraint| constraint.name), None, "100 is below 120");
    od.write(0x2012, 2, &[121], &mut ()).unwrap();
    assert_eq!(od.broken_constraint().map(|constraint| constraint.name), Some("self 2"));
}

#[test]
fn elements_in_several_places_are_read_where_they_lie() {
    let od = Nasty::new(7);
    for (sub, value) in [(1, 12), (2, 0x2222_2222), (3, 0x3333_3333u32)] {
        assert_eq!(*od.read(0x2009, sub).unwrap(), value.to_le_bytes());
    }
    assert_eq!((od.mixed().ch_1(), od.mixed().ch_2(), od.mixed().ch_3()), (12, 0x2222_2222, 0x3333_3333));
}

#[test]
fn a_placeholder_keeps_its_place_whatever_the_count() {
    for count in 1..=3u8 {
        let mut od = Nasty::new(1);
        let off = (1u32 << 31 | 0x201).to_le_bytes();
        od.write(0x1400, 1, &off, &mut ()).unwrap();
        od.write(0x1600, 0, &[0], &mut ()).unwrap();
        od.write(0x1600, 0, &[count], &mut ()).unwrap();
        od.write(0x1400, 1, &0x201u32.to_le_bytes(), &mut ()).unwrap();
        let received = pdo::unpack(&mut od, 1, &[7, 8, 9][..count.into()], &mut ()).unwrap();
        assert_eq!(received.refused, None);
        let expected = [(0, 0), (8, 0), (8, 9)][usize::from(count) - 1];
        assert_eq!((od.x().0, od.y()), expected, "{count} mapped");
    }
}

#[test]
fn bits_in_pdos_are_packed_without_gaps() {
    let mut od = Nasty::new(1);
    assert_eq!(pdo::unpack_consistent(&mut od, 2, &[0b0000_0101, 0b1], &mut ()).unwrap().refused, None);
    assert!(od.flag());
    assert_eq!(od.x().0, 0b1000_0010);
    let sent = pdo::pack(&mut od, 1, &mut ()).unwrap();
    assert_eq!(*sent, [0b0000_0101, 0b1]);
    assert_eq!(dictionary::pdos::Tpdo1::of(&od).pack(), *sent);
    assert_eq!(dictionary::pdos::Tpdo1::unpack([0b0000_0101, 0b1]), dictionary::pdos::Tpdo1::of(&od));
}

#[test]
fn words_with_a_sign_have_states_and_commands() {
    assert_eq!(machines::DriveState::of(-1), Some(machines::DriveState::High));
    assert_eq!(machines::DriveState::of(1), Some(machines::DriveState::Low));
    assert_eq!(machines::DriveCommand::Set.apply(1), i16::MIN + 1);
    assert!(machines::DriveCommand::Set.is_in(-5));
}

#[test]
fn rows_beyond_the_table_are_nothing() {
    assert_eq!(Nasty::new(1).table().id(u16::MAX), EntryId { index: 0, sub: 0 });
    assert_eq!(Nasty::new(1).entry(u16::MAX), None);
    assert_eq!(dictionary::limits::LIMITED_BITS, types::SignedBits(0xFFF6)..=types::SignedBits(10));
    let mut od = Nasty::new(1);
    assert_eq!(od.set_gaps(2, 7), Some(()));
    assert_eq!((od.gaps(1), od.gaps(2), od.gaps(4)), (Some(0), Some(7), None));
    od.set_type(dictionary::units::T(3));
    assert_eq!(od.type_().to_string(), "3 T");
}

#[test]
fn what_is_like_another_object_has_its_values_and_limits() {
    let mut od = Nasty::new(1);
    assert_eq!(*od.read(0x2012, 2).unwrap(), [100]);
    assert_eq!(*od.read(0x2013, 2).unwrap(), [100, 0]);
    for (sub, most) in [(1, 9u16), (2, 200), (3, 300)] {
        assert_eq!(od.write(0x2013, sub, &(most + 1).to_le_bytes(), &mut ()), Err(AbortCode::TOO_HIGH));
        assert!(od.write(0x2013, sub, &most.to_le_bytes(), &mut ()).is_ok());
    }
}

#[test]
fn runs_of_entries_are_mapped_one_by_one() {
    let mut od = Nasty::new(1);
    assert_eq!(*pdo::pack(&mut od, 2, &mut ()).unwrap(), [9, 3, 3, 3]);
}

#[test]
fn every_element_has_its_own_default() {
    let od = Nasty::new(1);
    assert_eq!([1, 2, 3].map(|sub| od.read(0x2015, sub).unwrap()[0]), [0xFF, 0, 0xFF]);
}

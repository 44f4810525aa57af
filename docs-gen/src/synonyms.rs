//! What people type for what documents say otherwise: abbreviations of the field, and German words for the names of standards.

use od_spec::wording;

/// Phrases that mean the same. A search for one of them finds the others.
pub(crate) type Synonyms = &'static [&'static str];

const ENGLISH: &[Synonyms] = &[
    &["pp", "profile position"],
    &["pv", "profile velocity"],
    &["tq", "profile torque"],
    &["vl", "velocity mode"],
    &["hm", "homing", "referencing"],
    &["ip", "interpolated position"],
    &["csp", "cyclic synchronous position"],
    &["csv", "cyclic synchronous velocity"],
    &["cst", "cyclic synchronous torque"],
    &["bit rate", "baud rate", "baudrate"],
    &["COB-ID", "CAN-ID"],
    &["fault reset", "error reset", "reset fault", "reset error"],
    &["DC link", "intermediate circuit"],
    &["rpm", "1/min", "revolution per minute", "revolutions per minute"],
    &["emcy", "emergency"],
    &["hb", "heartbeat"],
    &["id", "identifier"],
    &["r(w)", "(w)", "unlock", "unlocked", "locked", "service"],
    &["ro", "read only"],
    &["wo", "write only"],
    &["rw", "read write"],
    &["u8", "uint8", "unsigned8"],
    &["u16", "uint16", "unsigned16"],
    &["u32", "uint32", "unsigned32"],
    &["u64", "uint64", "unsigned64"],
    &["i8", "int8", "integer8"],
    &["i16", "int16", "integer16"],
    &["i32", "int32", "integer32"],
    &["i64", "int64", "integer64"],
];

const GERMAN: &[Synonyms] = &[
    &["Zustandswort", "Statuswort", "statusword"],
    &["Steuerwort", "controlword"],
    &["Schleppfehler", "Schleppabstand", "following error"],
    &["Referenzfahrt", "Referenzierung", "homing"],
    &["Referenzfahrtmethode", "homing method"],
    &["Betriebsart", "modes of operation", "mode of operation"],
    &["Istwert", "actual value"],
    &["Istposition", "position actual value"],
    &["Istgeschwindigkeit", "velocity actual value"],
    &["Istmoment", "torque actual value"],
    &["Zielposition", "target position"],
    &["Positionsfenster", "position window"],
    &["Zielgeschwindigkeit", "Sollgeschwindigkeit", "target velocity"],
    &["Geschwindigkeit", "velocity", "speed"],
    &["Drehmoment", "Moment", "torque"],
    &["Strom", "current"],
    &["Spannung", "voltage"],
    &["Unterspannung", "undervoltage", "under voltage"],
    &["Überspannung", "overvoltage", "over voltage"],
    &["Zwischenkreis", "DC link"],
    &["Temperatur", "temperature"],
    &["Beschleunigung", "acceleration"],
    &["Verzögerung", "Bremsrampe", "deceleration"],
    &["Schnellhalt", "Schnellstopp", "quick stop"],
    &["Getriebefaktor", "Getriebeübersetzung", "gear ratio"],
    &["Momentengrenze", "Drehmomentgrenze", "maximales Drehmoment", "max torque"],
    &["Motornennstrom", "motor rated current"],
    &["Maximalstrom", "maximaler Strom", "max current"],
    &["Nullpunkt", "Referenzpunkt", "home offset"],
    &["Positionsgrenze", "Softwareendlage", "software position limit"],
    &["Fehler", "fault", "error"],
    &["Fehlercode", "error code"],
    &["Fehlerregister", "error register"],
    &["Fehler quittieren", "Fehlerquittierung", "Fehler zurücksetzen", "Fehler löschen", "fault reset"],
    &["Warnung", "warning"],
    &["Bitrate", "Baudrate", "bit rate", "baud rate"],
    &["1/min", "U/min", "rpm", "Umdrehungen pro Minute", "revolutions per minute"],
    &["Gerätetyp", "device type"],
    &["Seriennummer", "serial number"],
    &["Herstellername", "vendor"],
    &["Parameter speichern", "store parameters"],
    &["Werkseinstellung", "Vorgaben wiederherstellen", "restore default parameters"],
    &["digitale Eingänge", "digital inputs"],
    &["digitale Ausgänge", "digital outputs"],
    &["entsperren", "entsperrt", "gesperrt", "r(w)", "(w)", "Service"],
    &["nur lesbar", "ro"],
    &["Knotennummer", "node-ID"],
];

/// The phrases that a search in documents of a language takes for one another. Names of objects are English everywhere.
pub(crate) fn of(language: wording::Language) -> Vec<Synonyms> {
    match language {
        wording::Language::English => ENGLISH.to_vec(),
        wording::Language::German => [GERMAN, ENGLISH].concat(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn german_documents_have_the_words_of_both_languages() {
        let phrases = |language| of(language).concat();
        assert!(!phrases(wording::Language::English).contains(&"Zustandswort"));
        for phrase in ["Zustandswort", "csp"] {
            assert!(phrases(wording::Language::German).contains(&phrase));
        }
    }

    #[test]
    fn every_phrase_has_another() {
        for synonyms in of(wording::Language::German) {
            assert!(synonyms.len() > 1, "{synonyms:?}");
        }
    }
}

//! The PMC and the Fullmo drive by a build script, to be compared with what the other ways give.

fn main() {
    od_gen::Builder::new("../od-spec/devices/pitch-control-system.od.yaml").device("pmc").generate();
    od_gen::Builder::new("../od-spec/devices/fullmo-drive.od.yaml").generate();
}

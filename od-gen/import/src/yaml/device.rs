//! What is before the objects: the file's header, the maker and the device.

use od_spec::model::{Date, DateTime, DynamicChannel};

use super::context::Context;
use super::eds::EdsDefaults;
use super::further;
use super::node::{Item, Node};
use super::remarks::Broken;
use super::texts::{one_or_more, open, words};

/// The keys before `units:`.
pub(super) fn header(context: &Context<'_>, uses: &[String]) -> Vec<Item> {
    let system = context.system;
    let mut items =
        vec![Item::new("od-spec", Node::plain(1)), Item::new("title", Node::text(system.title.clone()))];
    if system.languages != ["en"] {
        let languages = system.languages.iter().map(|language| Node::text(language.clone()));
        items.push(Item::new("languages", Node::List(languages.collect())));
    }
    let vendor = &system.vendor;
    if vendor.name != "unknown" || vendor.number != 0 {
        let mut vendor_items = vec![Item::new("name", Node::text(vendor.name.clone()))];
        if vendor.number != 0 {
            vendor_items.push(Item::new("number", Node::hex32(vendor.number)));
        }
        items.push(Item::new("vendor", Node::Map(vendor_items)));
    }
    if !uses.is_empty() {
        items.push(Item::new("uses", Node::List(uses.iter().map(Node::plain).collect())));
    }
    let allowed = &context.remarks.allowed;
    if !allowed.is_empty() {
        let reasons = allowed.iter().map(|(code, broken)| Item::new(*code, allowed_rule(broken)));
        items.push(Item::new("allow", Node::Block(reasons.collect())));
    }
    items
}

/// `devices:`.
pub(super) fn device(context: &Context<'_>, features: &[String]) -> Item {
    let device = context.device;
    let info = &device.info;
    let mut items = vec![Item::new("name", Node::text(device.name.clone()))];
    let mut add = |key: &str, node: Option<Node>| items.extend(node.map(|node| Item::new(key, node)));
    let number = |number: u32| (number != 0).then(|| Node::hex32(number));
    let flag = |flag: bool, usual: bool| (flag != usual).then(|| Node::yes_no(flag));
    let list = |list: Vec<Node>| (!list.is_empty()).then_some(Node::List(list));
    add("about", words(&device.about, context.language()));
    add("gap", open(&device.about, context.language()));
    let named = info.product_name != device.name;
    add("product-name", named.then(|| Node::text(info.product_name.clone())));
    add("product", number(info.product));
    add("product-revision", number(info.product_revision));
    let ordered = info.order_code != info.product_name;
    add("order-code", ordered.then(|| Node::text(info.order_code.clone())));
    add("bit-rates", list(info.bit_rates.iter().map(Node::plain).collect()));
    add("device-type", number(info.device_type));
    add("granularity", (info.granularity != 8).then(|| Node::plain(info.granularity)));
    add("boot-up-master", flag(info.boot_up_master, false));
    add("boot-up-slave", flag(info.boot_up_slave, true));
    add("group-messaging", flag(info.group_messaging, false));
    add("lss", flag(info.lss, false));
    add("dummies", list(info.dummies.iter().map(|data_type| Node::plain(data_type.name())).collect()));
    add("dynamic-channels", channels(context));
    add("features", list(features.iter().map(|feature| Node::text(feature.clone())).collect()));
    add("canopennode", further::canopennode(context));
    let eds = eds(context);
    add("eds", (!eds.is_empty()).then_some(Node::Map(eds)));
    let differs = device
        .entries()
        .any(|(.., entry)| entry.default.is_some() && !super::eds::default_shown(entry, EdsDefaults::Safe));
    add("eds-defaults", (context.eds == EdsDefaults::All && differs).then(|| Node::plain("all")));
    let above = context.above_device();
    let item = Item::new(device.key.clone(), Node::Block(items));
    Item::new("devices", Node::Block(vec![Item { above, ..item }]))
}

/// `dynamic-channels:`, where there are any.
fn channels(context: &Context<'_>) -> Option<Node> {
    let channels = &context.device.info.dynamic_channels;
    let item = |channel: &DynamicChannel| {
        let (first, last) = (super::objects::key(channel.first), super::objects::key(channel.last));
        let range = if first == last { first } else { format!("{first}..{last}") };
        let mut items = vec![
            Item::new("type", Node::plain(channel.data_type.name())),
            Item::new("access", Node::plain(channel.access.word())),
            Item::new("offset", Node::plain(channel.offset)),
        ];
        let difference = channel.difference.map(Node::plain);
        items.extend(difference.map(|difference| Item::new("difference", difference)));
        Item::new(range, Node::Map(items))
    };
    (!channels.is_empty()).then(|| Node::Block(channels.iter().map(item).collect()))
}

/// `eds:` of the device.
fn eds(context: &Context<'_>) -> Vec<Item> {
    /// What a device has without `eds:`.
    const NO_DATE: DateTime = DateTime { date: Date { year: 2000, month: 1, day: 1 }, hour: 0, minute: 0 };
    let (device, file) = (context.device, &context.device.file);
    let mut items = Vec::new();
    let mut add = |key: &str, node: Option<Node>| items.extend(node.map(|node| Item::new(key, node)));
    let text = |text: &str, usual: &str| (text != usual).then(|| Node::text(text));
    let number = |number: u8, usual: u8| (number != usual).then(|| Node::plain(number));
    add("description", text(&file.description, &device.name));
    add("created", Some(Node::Plain(date_time(file.created))));
    add("created-by", text(&file.created_by, &context.system.vendor.name));
    add("modified", (file.modified != file.created).then(|| Node::Plain(date_time(file.modified))));
    add("modified-by", text(&file.modified_by, &file.created_by));
    add("file-version", number(file.version, 1));
    add("file-revision", number(file.revision, 0));
    let further = further::of_eds(device);
    if items.len() == 1 && file.created == NO_DATE && further.is_empty() {
        return Vec::new();
    }
    items.extend(further);
    items
}

/// `2009-05-27 09:00`.
fn date_time(at: DateTime) -> String {
    let Date { year, month, day } = at.date;
    format!("{year:04}-{month:02}-{day:02} {:02}:{:02}", at.hour, at.minute)
}

/// What an allowed rule says: which objects break it, and what one of them says.
fn allowed_rule(broken: &Broken) -> Node {
    let Some(at) = &broken.at else {
        return Node::text(format!("as in the original: {}", broken.first));
    };
    let reason = match at.len() {
        1 => format!("as in the original: {}", broken.first),
        _ => "as in the original".to_owned(),
    };
    let at = at.iter().map(|index| Node::Plain(index.notation())).collect();
    Node::Map(vec![Item::new("at", one_or_more(at)), Item::new("about", Node::text(reason))])
}

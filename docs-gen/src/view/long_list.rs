//! Lists that may be long, such as the objects of a device: what templates see of an item is made when they come to it.

use std::fmt::Debug;
use std::ops::Deref;
use std::sync::Arc;

use minijinja::value::{Enumerator, Object, ObjectRepr, Serde, Value, serializing_for_value};
use serde::{Serialize, Serializer};

/// A list whose items are shown to templates one by one: all at once they would take several times the memory.
#[derive(Debug, Clone)]
pub struct LongList<T>(Arc<Vec<T>>);

impl<T> Deref for LongList<T> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<T> Default for LongList<T> {
    fn default() -> Self {
        Self(Arc::default())
    }
}

impl<T: Clone> LongList<T> {
    /// The items, to be changed.
    pub(crate) fn items_mut(&mut self) -> &mut [T] {
        Arc::<Vec<T>>::make_mut(&mut self.0)
    }
}

impl<T> FromIterator<T> for LongList<T> {
    fn from_iter<I: IntoIterator<Item = T>>(items: I) -> Self {
        Self(Arc::new(items.into_iter().collect()))
    }
}

impl<T: Serialize + Debug + Send + Sync + 'static> Serialize for LongList<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if serializing_for_value() {
            Value::from_object(Items(Arc::clone(&self.0))).serialize(serializer)
        } else {
            serializer.collect_seq(self.iter())
        }
    }
}

/// The list as a template sees it.
#[derive(Debug)]
struct Items<T>(Arc<Vec<T>>);

impl<T: Serialize + Debug + Send + Sync + 'static> Object for Items<T> {
    fn repr(self: &Arc<Self>) -> ObjectRepr {
        ObjectRepr::Seq
    }

    fn get_value(self: &Arc<Self>, position: &Value) -> Option<Value> {
        self.0.get(position.as_usize()?).map(|item| Value::from(Serde(item)))
    }

    fn enumerate(self: &Arc<Self>) -> Enumerator {
        Enumerator::Seq(self.0.len())
    }
}

#[cfg(test)]
mod tests {
    use minijinja::{Environment, context};

    use super::*;

    #[test]
    fn templates_and_json_see_a_list() {
        let list: LongList<Vec<u8>> = [vec![1, 2], vec![], vec![3]].into_iter().collect();
        assert_eq!(list.len(), 3);
        let seen = |template: &str| {
            Environment::new().render_str(template, context! { list => Value::from(Serde(&list)) }).unwrap()
        };
        assert_eq!(
            seen("{% for one in list %}{{ one }}{{ ';' if not loop.last }}{% endfor %}"),
            "[1, 2];[];[3]"
        );
        assert_eq!(
            seen("{{ list|length }} {{ list[0][1] }} {{ list[1:]|length }} {{ list|last }}"),
            "3 2 2 [3]"
        );
        assert_eq!(serde_json::to_string(&list).unwrap(), "[[1,2],[],[3]]");
    }
}

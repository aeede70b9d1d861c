//! What is known about a value and is no part of it.

/// Something that is known about a value and is no part of it, such as the line on which it was read: any two are equal, and it is
/// not written.
#[derive(Clone, Copy, Debug, Default)]
pub struct Aside<T>(pub T);

impl<T> PartialEq for Aside<T> {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl<T> Eq for Aside<T> {}

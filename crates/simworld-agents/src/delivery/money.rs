//! Money in whole cents, and the double-entry ledger that keeps it conserved to the cent.

use std::fmt;
use std::ops::{Add, Sub};

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// An amount of money, whole cents.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Cents(pub i64);

impl Cents {
    /// Nothing.
    pub const ZERO: Self = Self(0);

    /// The amount nearest to that many dollars; `None` for a number that is not finite or beyond a billion.
    pub fn from_dollars(dollars: f64) -> Option<Self> {
        (dollars.is_finite() && dollars.abs() <= 1e9).then(|| Self((dollars * 100.0).round() as i64))
    }

    /// In dollars.
    pub fn dollars(self) -> f64 {
        self.0 as f64 / 100.0
    }

    /// This amount times a factor, rounded to the cent.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self((self.0 as f64 * factor).round() as i64)
    }
}

impl Add for Cents {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for Cents {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl fmt::Display for Cents {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.0 < 0 { "-" } else { "" };
        write!(f, "{sign}${}.{:02}", self.0.unsigned_abs() / 100, self.0.unsigned_abs() % 100)
    }
}

/// Whose money.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Account {
    /// A courier's purse, by the courier's place in the list of agents.
    Courier(usize),
    /// What customers paid for orders not yet delivered, and bounties not yet earned.
    Escrow,
    /// What the platform keeps.
    Platform,
    /// What the shops took.
    Shops,
    /// The world outside; what leaves it is the customers' inflow.
    Customers,
}

/// A payment that an account cannot make.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("the payment is {asked} and the account holds {held}")]
pub struct Overdrawn {
    /// What was to be paid.
    pub asked: Cents,
    /// What was there.
    pub held: Cents,
}

/// Accounts between which money moves; it is neither made nor lost.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Ledger {
    couriers: Vec<Cents>,
    escrow: Cents,
    platform: Cents,
    shops: Cents,
    inflow: Cents,
    endowment: Cents,
}

impl Ledger {
    /// `couriers` purses of `initial` each.
    pub fn new(couriers: usize, initial: Cents) -> Self {
        let endowment = Cents(initial.0 * couriers as i64);
        Self { couriers: vec![initial; couriers], endowment, ..Self::default() }
    }

    /// What an account holds; for the customers, what they paid in so far.
    pub fn balance(&self, account: Account) -> Cents {
        match account {
            Account::Courier(index) => self.couriers.get(index).copied().unwrap_or_default(),
            Account::Escrow => self.escrow,
            Account::Platform => self.platform,
            Account::Shops => self.shops,
            Account::Customers => self.inflow,
        }
    }

    /// What the couriers held at the start, together.
    pub fn endowment(&self) -> Cents {
        self.endowment
    }

    /// Moves money from one account to another.
    ///
    /// # Errors
    /// The payer has less, or the amount is negative; then nothing has moved. Customers never run out.
    pub fn pay(&mut self, from: Account, to: Account, amount: Cents) -> Result<(), Overdrawn> {
        let held = self.balance(from);
        if amount < Cents::ZERO || (from != Account::Customers && held < amount) {
            return Err(Overdrawn { asked: amount, held });
        }
        self.enter(from, Cents(-amount.0));
        self.enter(to, amount);
        Ok(())
    }

    /// Customers count what they paid in, so their entries have the other sign.
    fn enter(&mut self, account: Account, amount: Cents) {
        match account {
            Account::Courier(index) => {
                if let Some(purse) = self.couriers.get_mut(index) {
                    *purse = *purse + amount;
                }
            }
            Account::Escrow => self.escrow = self.escrow + amount,
            Account::Platform => self.platform = self.platform + amount,
            Account::Shops => self.shops = self.shops + amount,
            Account::Customers => self.inflow = self.inflow - amount,
        }
    }

    /// Couriers + escrow + platform + shops - (endowment + inflow): zero while money is conserved.
    pub fn imbalance(&self) -> Cents {
        let purses = self.couriers.iter().fold(Cents::ZERO, |sum, purse| sum + *purse);
        purses + self.escrow + self.platform + self.shops - self.endowment - self.inflow
    }

    /// Whether no account is overdrawn.
    pub fn is_solvent(&self) -> bool {
        let others = [self.escrow, self.platform, self.shops];
        self.couriers.iter().chain(&others).all(|balance| *balance >= Cents::ZERO)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_payment_beyond_the_purse_moves_nothing() {
        let mut ledger = Ledger::new(2, Cents(500));
        let before = ledger.clone();
        assert!(ledger.pay(Account::Courier(0), Account::Shops, Cents(501)).is_err());
        assert!(ledger.pay(Account::Courier(0), Account::Shops, Cents(-1)).is_err());
        assert_eq!(ledger, before);
    }

    #[test]
    fn customers_bring_money_in_and_it_stays_counted() {
        let mut ledger = Ledger::new(1, Cents(500));
        ledger.pay(Account::Customers, Account::Escrow, Cents(1500)).unwrap();
        ledger.pay(Account::Escrow, Account::Courier(0), Cents(1200)).unwrap();
        ledger.pay(Account::Escrow, Account::Platform, Cents(300)).unwrap();
        assert_eq!(ledger.balance(Account::Courier(0)), Cents(1700));
        assert_eq!(ledger.balance(Account::Customers), Cents(1500));
        assert_eq!(ledger.imbalance(), Cents::ZERO);
    }

    #[test]
    fn amounts_read_as_dollars() {
        assert_eq!(Cents(-1205).to_string(), "-$12.05");
        assert_eq!(Cents::from_dollars(12.345), Some(Cents(1235)));
        assert_eq!(Cents::from_dollars(f64::NAN), None);
    }
}

//! The energy ledger: what is kinetic, what is elastic, and what work was done from outside.
//!
//! Leapfrog of a linear body keeps exactly, but for rounding, H = ½ρV Σ v(n+½)² + ½ u(n)ᵀK u(n+1), and a force f from
//! outside changes it by exactly f(n)·(u(n+1) − u(n−1))/2. So H less the work is constant to rounding whatever the load,
//! the damping and the driven nodes do: a check of the whole step. With finite rotations ½ u(n)ᵀK u(n+1) becomes
//! ½(E(n) + E(n+1)) + ¼ d·(F(n+1) − F(n)), the same for a linear body, and the balance holds as far as a step is linear.
//! Bonds that break between two steps take their part of this form with them: ½ u(n)ᵀk u(n+1), an account of its own.

use crate::breaking::Broken;
use crate::field::{Field, Window};
use crate::forces::{Class, Now};
use crate::model::{Inertia, Model};

/// Accounts in J, at half steps.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Balance {
    /// ½ρV Σ v(n+½)².
    pub kinetic: f64,
    /// ½ u(n)ᵀK u(n+1).
    pub elastic: f64,
    /// Work of the loads since the start.
    pub loads: f64,
    /// Work of forces that depend on the velocity: minus what damping took.
    pub rates: f64,
    /// Work of driven nodes.
    pub constraints: f64,
    /// What bonds held when they were cut, since the start.
    pub cut_bonds: f64,
}

impl Balance {
    /// What stays constant.
    pub fn closed(&self) -> f64 {
        self.kinetic + self.elastic - self.loads - self.rates - self.constraints + self.cut_bonds
    }
}

/// Books every step.
pub struct Ledger<const D: usize> {
    balance: Balance,
    /// What bonds held that were cut after the step booked last: the next step no longer has them.
    cut: f64,
    /// Forces after those of class internal, and after the loads.
    internal: Field,
    loaded: Field,
    before: Field,
    /// E(n), where ½uᵀKu is not the energy.
    energy: Option<f64>,
    /// Forces of class internal at n + 1, where they are needed for the energy.
    next: Field,
}

impl<const D: usize> Ledger<D> {
    pub fn new(model: &Model<D>) -> Self {
        let field = || model.grid.field();
        Self {
            balance: Balance::default(),
            cut: 0.0,
            internal: field(),
            loaded: field(),
            before: field(),
            energy: None,
            next: if model.linear { Field::default() } else { field() },
        }
    }

    /// The accounts half a step before the march's present time.
    pub fn balance(&self) -> Balance {
        self.balance
    }

    /// Sums the forces as [`Model::force`] does, noting what each class added.
    pub(crate) fn sum_forces(&mut self, model: &Model<D>, now: &Now<'_>, force: &mut [f64]) {
        force.fill(0.0);
        model.add_forces(model.of_class(Class::Internal), now, force);
        self.internal.copy_from_slice(force);
        model.add_forces(model.of_class(Class::Load), now, force);
        self.loaded.copy_from_slice(force);
        model.add_forces(model.of_class(Class::Rate), now, force);
        if !model.linear {
            self.energy = Some(model.energy(now));
        }
    }

    /// Notes what bonds held that broke after the step booked last; `before` is what was broken then.
    pub(crate) fn release(&mut self, model: &Model<D>, now: &Now<'_>, before: &Broken) {
        let pairs = now.displacement.values().iter().zip(now.increment.values());
        let mut earlier: Field = pairs.map(|(u, d)| u - d).collect();
        model.fill_ghosts(&mut earlier);
        self.cut +=
            model.released(&Now { displacement: Window::from(&earlier), broken: before, ..*now }, now);
    }

    /// Keeps d(n), and hands it back when the step is done.
    pub(crate) fn remember(&mut self, increment: &[f64]) -> Field {
        let mut before = std::mem::take(&mut self.before);
        before.copy_from_slice(increment);
        before
    }

    /// Books a step from d(n), the force at n, and the state at n+1 with the bonds of n.
    pub(crate) fn book(&mut self, model: &Model<D>, before: Field, force: &[f64], now: &Now<'_>) {
        let Now { displacement, increment, time_step, .. } = *now;
        let mut sums = Balance::default();
        for node in model.grid.each() {
            for axis in 0..D {
                let at = model.grid.place(node) + axis * model.grid.stride();
                let inertia = match &model.inertia {
                    Inertia::Uniform(density) => *density,
                    Inertia::Diagonal(densities) => densities[at],
                } / (time_step * time_step);
                let (d, next, u) = (before[at], increment[at], displacement[at]);
                let mean = 0.5 * (d + next);
                sums.kinetic += 0.5 * inertia * next * next;
                sums.elastic -= 0.5 * self.internal[at] * u;
                sums.loads += (self.loaded[at] - self.internal[at]) * mean;
                sums.rates += (force[at] - self.loaded[at]) * mean;
                sums.constraints += (inertia * (next - d) - force[at]) * mean;
            }
        }
        let volume = model.cell_volume;
        self.balance.cut_bonds += std::mem::take(&mut self.cut);
        self.balance.kinetic = volume * sums.kinetic;
        self.balance.elastic = volume * sums.elastic;
        self.balance.loads += volume * sums.loads;
        self.balance.rates += volume * sums.rates;
        if !model.constraints.is_empty() {
            self.balance.constraints += volume * sums.constraints;
        }
        if let Some(energy) = self.energy {
            self.next.fill(0.0);
            model.add_forces(model.of_class(Class::Internal), now, &mut self.next);
            let stiff = increment.values().iter().zip(self.next.iter().zip(self.internal.iter()));
            let bend: f64 = stiff.map(|(d, (next, force))| d * (next - force)).sum();
            self.balance.elastic = 0.5 * (energy + model.energy(now)) + 0.25 * volume * bend;
        }
        self.before = before;
    }
}

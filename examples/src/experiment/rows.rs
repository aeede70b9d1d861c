//! Results as Parquet, for notebooks: a file for each kind of row, every column with its type, and nothing to parse.

use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;
use simworld_agents::delivery::{CourierAction, CourierRow};
use thiserror::Error;

use super::trial::Trial;
use crate::delivery::{OutputError, OutputFolder};

/// Why the rows cannot be kept.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RowsError {
    /// The format refuses them.
    #[error("{name} cannot be written as Parquet: {source}")]
    Format {
        /// The file.
        name: &'static str,
        /// Why.
        source: ParquetError,
    },
    /// The folder cannot be written to.
    #[error(transparent)]
    Output(#[from] OutputError),
}

/// Writes `couriers.parquet` (a row a courier and trial), `bids.parquet` (a row a bid) and `metrics.parquet` (a row a metric and
/// trial). Money in dollars, lengths in metres, times in seconds; couriers and orders by number, from 0 in each trial.
///
/// # Errors
/// The folder cannot be written to.
pub fn keep_rows(trials: &[Trial], folder: &OutputFolder) -> Result<(), RowsError> {
    let files = [
        ("couriers.parquet", couriers(trials)),
        ("bids.parquet", bids(trials)),
        ("metrics.parquet", metrics(trials)),
    ];
    for (name, rows) in files {
        let bytes = rows.to_bytes().map_err(|source| RowsError::Format { name, source })?;
        folder.write(name, bytes)?;
    }
    Ok(())
}

/// The values of a column.
enum Values {
    Texts(Vec<ByteArray>),
    Whole(Vec<i64>),
    Real(Vec<f64>),
    Truth(Vec<bool>),
}

/// Columns of the same length, by name.
#[derive(Default)]
struct Rows {
    columns: Vec<(String, Values)>,
}

impl Rows {
    fn texts(&mut self, name: &str, values: impl IntoIterator<Item = impl AsRef<str>>) {
        let values = values.into_iter().map(|text| ByteArray::from(text.as_ref())).collect();
        self.columns.push((name.to_owned(), Values::Texts(values)));
    }

    fn whole(&mut self, name: &str, values: impl IntoIterator<Item = i64>) {
        self.columns.push((name.to_owned(), Values::Whole(values.into_iter().collect())));
    }

    fn real(&mut self, name: &str, values: impl IntoIterator<Item = f64>) {
        self.columns.push((name.to_owned(), Values::Real(values.into_iter().collect())));
    }

    fn truth(&mut self, name: &str, values: impl IntoIterator<Item = bool>) {
        self.columns.push((name.to_owned(), Values::Truth(values.into_iter().collect())));
    }

    /// The setting and the seed of each row.
    fn origin(&mut self, trials: &[&Trial]) {
        self.texts("setting", trials.iter().map(|trial| &trial.arm));
        self.real("level", trials.iter().map(|trial| trial.level));
        self.whole("seed", trials.iter().map(|trial| trial.seed.cast_signed()));
    }

    fn to_bytes(&self) -> Result<Vec<u8>, ParquetError> {
        let fields = self.columns.iter().map(|(name, values)| Ok(Arc::new(field(name, values)?)));
        let fields = fields.collect::<Result<_, ParquetError>>()?;
        let schema = Type::group_type_builder("rows").with_fields(fields).build()?;
        // No date and no version of a library: the same results are the same bytes.
        let properties = WriterProperties::builder().set_created_by("simworld".to_owned()).build();
        let mut bytes = Vec::new();
        let mut file = SerializedFileWriter::new(&mut bytes, Arc::new(schema), Arc::new(properties))?;
        let mut group = file.next_row_group()?;
        for (_, values) in &self.columns {
            write(&mut group, values)?;
        }
        group.close()?;
        file.close()?;
        Ok(bytes)
    }
}

fn field(name: &str, values: &Values) -> Result<Type, ParquetError> {
    let (physical, logical) = match values {
        Values::Texts(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        Values::Whole(_) => (Physical::INT64, None),
        Values::Real(_) => (Physical::DOUBLE, None),
        Values::Truth(_) => (Physical::BOOLEAN, None),
    };
    Type::primitive_type_builder(name, physical)
        .with_repetition(Repetition::REQUIRED)
        .with_logical_type(logical)
        .build()
}

fn write(
    group: &mut SerializedRowGroupWriter<'_, &mut Vec<u8>>,
    values: &Values,
) -> Result<(), ParquetError> {
    let Some(mut column) = group.next_column()? else {
        return Err(ParquetError::General("more columns than the schema has".to_owned()));
    };
    match values {
        Values::Texts(values) => column.typed::<ByteArrayType>().write_batch(values, None, None)?,
        Values::Whole(values) => column.typed::<Int64Type>().write_batch(values, None, None)?,
        Values::Real(values) => column.typed::<DoubleType>().write_batch(values, None, None)?,
        Values::Truth(values) => column.typed::<BoolType>().write_batch(values, None, None)?,
    };
    column.close()
}

fn couriers(trials: &[Trial]) -> Rows {
    let all: Vec<_> = trials
        .iter()
        .flat_map(|trial| trial.couriers().enumerate().map(move |(index, pair)| (trial, index, pair)))
        .collect();
    let mut rows = Rows::default();
    rows.origin(&all.iter().map(|(trial, ..)| *trial).collect::<Vec<_>>());
    rows.whole("courier", all.iter().map(|(_, index, _)| *index as i64));
    rows.texts("policy", all.iter().map(|(_, _, (player, _))| player.policy.as_str()));
    let mut of_player = |name: &str, figure: fn(&crate::delivery::Player) -> f64| {
        rows.real(name, all.iter().map(|(_, _, (player, _))| figure(player)));
    };
    of_player("openness", |player| player.persona.openness);
    of_player("conscientiousness", |player| player.persona.conscientiousness);
    of_player("extraversion", |player| player.persona.extraversion);
    of_player("agreeableness", |player| player.persona.agreeableness);
    of_player("neuroticism", |player| player.persona.neuroticism);
    let reports: Vec<_> = all.iter().map(|(_, _, (_, report))| *report).collect();
    for (name, figure) in REAL {
        rows.real(name, reports.iter().map(|report| figure(report)));
    }
    for (name, figure) in WHOLE {
        rows.whole(name, reports.iter().map(|report| i64::from(figure(report))));
    }
    for (place, name) in CourierAction::NAMES.iter().enumerate() {
        let count = |report: &&CourierRow| report.actions.get(place).map_or(0, |action| i64::from(action.1));
        rows.whole(&format!("action_{name}"), reports.iter().map(count));
    }
    rows
}

/// A figure of a courier, and what its column is called.
type Figure<T> = (&'static str, fn(&CourierRow) -> T);

/// Figures of a courier that are no counts.
const REAL: [Figure<f64>; 7] = [
    ("profit", |row| row.profit.dollars()),
    ("earned", |row| row.earned.dollars()),
    ("mean_bid", |row| row.mean_bid),
    ("energy", |row| row.energy),
    ("power", |row| row.power),
    ("distance", |row| row.distance),
    ("completion_time", |row| row.completion_time),
];

/// Counts of a courier.
const WHOLE: [Figure<u32>; 12] = [
    ("bids", |row| row.bids),
    ("won", |row| row.won),
    ("picked_up", |row| row.picked_up),
    ("delivered", |row| row.delivered),
    ("late", |row| row.late),
    ("shared", |row| row.shared),
    ("handed_over", |row| row.handed_over),
    ("scooters", |row| row.scooters),
    ("drinks", |row| row.drinks),
    ("swaps", |row| row.swaps),
    ("exhaustions", |row| row.exhaustions),
    ("refused", |row| row.refused),
];

fn bids(trials: &[Trial]) -> Rows {
    let of = |trial: &'_ Trial| -> Vec<(usize, f64, usize, f64, bool)> {
        let auctions = trial.auctions.iter().enumerate();
        let each = auctions.flat_map(|(order, auction)| {
            let won = move |who| auction.winner == Some(who);
            auction.bids.iter().map(move |(who, price)| (order, auction.ceiling, *who, *price, won(*who)))
        });
        each.collect()
    };
    let all: Vec<_> =
        trials.iter().flat_map(|trial| of(trial).into_iter().map(move |bid| (trial, bid))).collect();
    let mut rows = Rows::default();
    rows.origin(&all.iter().map(|(trial, _)| *trial).collect::<Vec<_>>());
    rows.whole("order", all.iter().map(|(_, bid)| bid.0 as i64));
    rows.real("ceiling", all.iter().map(|(_, bid)| bid.1));
    rows.whole("courier", all.iter().map(|(_, bid)| bid.2 as i64));
    rows.texts("policy", all.iter().map(|(trial, bid)| trial.players[bid.2].policy.as_str()));
    rows.real("price", all.iter().map(|(_, bid)| bid.3));
    rows.truth("won", all.iter().map(|(_, bid)| bid.4));
    rows
}

fn metrics(trials: &[Trial]) -> Rows {
    let all: Vec<_> =
        trials.iter().flat_map(|trial| trial.metrics.iter().map(move |metric| (trial, metric))).collect();
    let mut rows = Rows::default();
    rows.origin(&all.iter().map(|(trial, _)| *trial).collect::<Vec<_>>());
    rows.texts("metric", all.iter().map(|(_, metric)| &metric.0));
    rows.real("value", all.iter().map(|(_, metric)| metric.1));
    rows
}

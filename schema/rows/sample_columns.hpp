// SPDX-License-Identifier: GPL-3.0-or-later

// The only list of the columns of the table samples: rows are read, written, compared, averaged and
// summed up by it. A new column is a line here, a member of Sample, and ALTER TABLE samples
// in a script. Units and meaning: 001-store.sql and the scripts after it. Private to schema/.
#pragma once

#include <array>
#include <optional>

#include "schema/rows/measured.hpp"

namespace haff::schema {

// The view that averages a column over realizations.
enum class MeanView { series, temperatures, both };

struct SampleColumn {
  const char* name;
  std::optional<double> Sample::*value;
  MeanView view;
};

// All but job_id, tau and time, which every sample has.
inline constexpr std::array sample_columns{
    SampleColumn{"temperature", &Sample::temperature, MeanView::both},
    SampleColumn{"gamma_ratio", &Sample::gamma_ratio, MeanView::series},
    SampleColumn{"collision_rate", &Sample::collision_rate, MeanView::series},
    SampleColumn{"pressure", &Sample::pressure, MeanView::series},
    SampleColumn{"a2", &Sample::a2, MeanView::series},
    SampleColumn{"a3", &Sample::a3, MeanView::series},
    SampleColumn{"a4", &Sample::a4, MeanView::series},
    SampleColumn{"a5", &Sample::a5, MeanView::series},
    SampleColumn{"a6", &Sample::a6, MeanView::series},
    SampleColumn{"correlation_trace", &Sample::correlation_trace, MeanView::series},
    SampleColumn{"largest_cluster", &Sample::largest_cluster, MeanView::series},
    SampleColumn{"rotational_temperature", &Sample::rotational_temperature, MeanView::temperatures},
    SampleColumn{"temperature_1", &Sample::temperature_1, MeanView::temperatures},
    SampleColumn{"temperature_2", &Sample::temperature_2, MeanView::temperatures},
};

}  // namespace haff::schema

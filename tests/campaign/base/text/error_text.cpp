// SPDX-License-Identifier: GPL-3.0-or-later

// The messages about errors of the store, with the command to type next.
#include "campaign/base/text/error_text.hpp"

#include <doctest/doctest.h>

#include "schema/error.hpp"

using namespace haff;
using campaign::error_text;

TEST_CASE("an error of the store ends with the command that would help") {
  CHECK(error_text(schema::NameError("a.db: is a folder", schema::Remedy::name_a_store)) ==
        "a.db: is a folder; name a store with --store FILE");
  CHECK(error_text(schema::NameError("a.db: is empty", schema::Remedy::plan, "a.db")) ==
        "a.db: is empty; make it with: campaign plan GRID.json --store a.db");
  CHECK(error_text(schema::Damage("x: differs", schema::Remedy::repair, "my store.db")) ==
        "x: differs; see: campaign verify --repair --store 'my store.db'");
}

TEST_CASE("the default store need not be named") {
  CHECK(error_text(
            schema::DamagedFile("campaign.db: is damaged", schema::Remedy::check, "campaign.db")) ==
        "campaign.db: is damaged; see: campaign verify");
}

TEST_CASE("other errors are passed on as they are") {
  CHECK(error_text(schema::StoreError("a.db: locked")) == "a.db: locked");
  CHECK(error_text(std::runtime_error("no")) == "no");
}

/// \file
/// The table of a corpus, as CSV and as Markdown.
#pragma once

#include <string>
#include <vector>

#include "tools/corpus_job.h"
#include "tools/published_table.h"

namespace hexweft::cli {

/// A row each mesh, and after those of a corpus one with the means over the meshes that are done.
std::string csv_table(const std::vector<CorpusRow>& rows, const PublishedTable& published);

/// A section each corpus, with fewer of the published columns.
std::string markdown_table(const std::vector<CorpusRow>& rows, const PublishedTable& published);

}  // namespace hexweft::cli

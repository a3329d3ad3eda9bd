// The flow graph of campaigns in the language DOT, for Graphviz: what waits for what, and what is done.
#pragma once

#include "engine/schedule/agenda.h"

#include <string>

namespace tamp::cli {

/// methods: one node for each entry of methods and each metric, with counts, whatever the size of the campaign.
/// jobs: one for each job.
enum class FlowDetail { methods, jobs };

/// A digraph from packings to what needs them. A node is filled in the colour that figures give its method; its border
/// is dashed while there is something left to run, dotted where all that is left cannot run. Edges count jobs. The
/// same agenda gives the same bytes.
std::string flow_dot(const Agenda& agenda, FlowDetail detail);

} // namespace tamp::cli

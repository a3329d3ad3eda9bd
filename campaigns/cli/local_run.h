// The joint of the house: the scheduler's doors lead to child processes of this program, the metrics and the store.
#pragma once

#include "engine/schedule/schedule.h"
#include "store/store.h"

#include <stop_token>

namespace tamp::cli {

/// Runs the open items of an agenda on this machine, but for those that other runs in the store are at or have ended
/// meanwhile; each record is in the store when the observer hears of it. The caller has a seat (shared_run.h). Errors
/// as in run_agenda.
Summary run_here(Store& store, const Agenda& agenda, const Resources& resources, Observer& observer,
                 const std::stop_token& stop);

/// Removes the job files and logs that children of a killed run left in the store's folder for incoming results.
void sweep_working_files(const Store& store);

} // namespace tamp::cli

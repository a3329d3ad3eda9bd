// The flow graph of a run:
//
//   dispatcher --> generation (async: waits in its own thread) --> sink (serial) --> dispatcher
//             \--> metric (TBB tasks) ---------------------------->/
#include "engine/schedule/schedule.h"

#include "engine/base/error.h"
#include "engine/schedule/dispatcher.h"
#include "engine/schedule/waiting_threads.h"

#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <utility>

namespace tamp {

namespace {

namespace flow = oneapi::tbb::flow;

/// What comes back from a job: a record, or the exception that a handler threw, or neither if the run was stopped.
struct Ended {
  std::size_t item = 0;
  std::optional<Record> record = {};
  std::exception_ptr failure = {};
};
using Message = std::shared_ptr<Ended>; // null: the first push, which nothing has ended for

/// One run, from its first job to its last.
class Run {
public:
  Run(const Agenda& agenda, const Resources& resources, const Handlers& handlers, const std::stop_token& stop)
      : agenda_(agenda), resources_(resources), handlers_(handlers), dispatcher_(agenda, resources),
        outer_stop_(stop, [this] { stop_.request_stop(); }),
        to_dispatcher_(graph_, flow::serial, [this](const Message& m, auto& ports) { dispatch(m, ports); }),
        generate_(graph_, flow::unlimited, [this](std::size_t i, Gateway& gateway) { generate(i, gateway); }),
        measure_(graph_, flow::unlimited, [this](std::size_t i) { return measure(i); }),
        to_sink_(graph_, flow::serial, [this](const Message& m) { return sink(m); }), threads_(resources.cores) {
    flow::make_edge(flow::output_port<0>(to_dispatcher_), generate_);
    flow::make_edge(flow::output_port<1>(to_dispatcher_), measure_);
    flow::make_edge(generate_, to_sink_);
    flow::make_edge(measure_, to_sink_);
    flow::make_edge(to_sink_, to_dispatcher_);
  }

  Summary operator()() {
    summary_.recorded = recorded_outcomes(agenda_);
    summary_.barred = agenda_.count(Standing::barred);
    summary_.cancelled = agenda_.count(Standing::open); // until they have run
    handlers_.observer.opened(agenda_);
    to_dispatcher_.try_put(Message{});
    graph_.wait_for_all();
    if (failure_)
      std::rethrow_exception(failure_);
    return summary_;
  }

private:
  using ToDispatcher = flow::multifunction_node<Message, std::tuple<std::size_t, std::size_t>>;
  using Generate = flow::async_node<std::size_t, Message>;
  using Gateway = Generate::gateway_type;

  /// The only place that counts, observes and decides.
  void dispatch(const Message& ended, ToDispatcher::output_ports_type& ports) {
    try {
      if (ended)
        account(*ended);
      if (stop_.stop_requested())
        return; // what runs comes back here, nothing more goes out
      for (const std::size_t i : dispatcher_.start()) {
        const Item& item = agenda_.items[i];
        handlers_.observer.started(item);
        const bool put =
            item.kind == JobKind::generation ? std::get<0>(ports).try_put(i) : std::get<1>(ports).try_put(i);
        if (!put)
          throw Error("the task graph refused job " + item.key);
      }
    } catch (...) {
      fail(std::current_exception());
    }
  }

  void account(const Ended& ended) {
    if (ended.failure)
      fail(ended.failure);
    const Item& item = agenda_.items[ended.item];
    const bool usable = ended.record && leaves_packing(ended.record->outcome);
    const std::vector<std::size_t> barred = dispatcher_.finish(ended.item, usable);
    if (!ended.record)
      return; // stopped, or left to others: it and all that waits for it remain open
    --summary_.cancelled;
    ++summary_.ran[static_cast<std::size_t>(ended.record->outcome)];
    handlers_.observer.finished(item, *ended.record);
    summary_.cancelled -= barred.size();
    summary_.barred += barred.size();
    for (const std::size_t i : barred)
      handlers_.observer.barred(agenda_.items[i]);
  }

  void generate(std::size_t i, Gateway& gateway) {
    gateway.reserve_wait(); // keeps wait_for_all waiting while no TBB task exists
    threads_.submit([this, i, &gateway] {
      const Task& task = agenda_.task(agenda_.items[i]);
      const bool exclusive = task.run.timing == TimingMode::exclusive;
      const std::optional<int> core = exclusive ? std::optional(resources_.pinned_core) : std::nullopt;
      gateway.try_put(ended(i, [&] { return handlers_.executor.run(task, core, stop_.get_token()); }));
      gateway.release_wait();
    });
  }

  Message measure(std::size_t i) {
    const Item& item = agenda_.items[i];
    return ended(i, [&] {
      // Isolated: while a loop inside waits for its parts it must not pick up another job, whose time it would count.
      return oneapi::tbb::this_task_arena::isolate(
          [&] { return handlers_.measure(agenda_.task(item), agenda_.metric(item)); });
    });
  }

  Message sink(const Message& message) {
    try {
      if (message->record)
        handlers_.sink(*message->record);
    } catch (...) {
      message->record.reset();
      message->failure = std::current_exception();
    }
    return message;
  }

  template <class F>
  Message ended(std::size_t i, F&& run) {
    auto message = std::make_shared<Ended>(Ended{.item = i});
    try {
      message->record = run();
    } catch (...) {
      message->failure = std::current_exception();
    }
    return message;
  }

  /// Keeps the first failure and stops the run. Called from the dispatcher alone.
  void fail(std::exception_ptr failure) {
    if (!failure_)
      failure_ = std::move(failure);
    stop_.request_stop();
  }

  const Agenda& agenda_;
  const Resources& resources_;
  const Handlers& handlers_;
  Dispatcher dispatcher_;
  Summary summary_;
  std::exception_ptr failure_;
  std::stop_source stop_; // of this run: requested from outside or by a failure
  std::stop_callback<std::function<void()>> outer_stop_;

  flow::graph graph_;
  ToDispatcher to_dispatcher_;
  Generate generate_;
  flow::function_node<std::size_t, Message> measure_;
  flow::function_node<Message, Message> to_sink_;

  WaitingThreads threads_; // goes first: its last work may still be leaving the graph
};

} // namespace

bool Summary::all_ok() const {
  constexpr auto kOk = static_cast<std::size_t>(Outcome::ok);
  for (std::size_t o = 0; o < ran.size(); ++o) {
    if (o != kOk && ran[o] + recorded[o] > 0)
      return false;
  }
  return barred == 0 && cancelled == 0;
}

Summary run_agenda(const Agenda& agenda, const Resources& resources, const Handlers& handlers,
                   const std::stop_token& stop) {
  // The graph belongs to the arena in which it is made, so metrics keep to as many threads as there are core tokens
  // (TBB has no more threads than the machine, and complains when asked for more).
  oneapi::tbb::task_arena arena(std::min(resources.cores, oneapi::tbb::info::default_concurrency()));
  return arena.execute([&] { return Run(agenda, resources, handlers, stop)(); });
}

} // namespace tamp

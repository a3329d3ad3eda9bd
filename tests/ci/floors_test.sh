#!/usr/bin/env bash
# Plants each breach that .ci/floors looks for in a copy of a tiny house, and sees it reported at its place; the sound house passes.
set -uo pipefail
floors="$(cd "$(dirname "$0")/../.." && pwd)/.ci/floors"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
passed=0
failed=0

# put FILE LINE...: writes a file of the house under test.
put() {
  mkdir -p "$(dirname "$house/$1")"
  printf '%s\n' "${@:2}" >"$house/$1"
}

# A sound house with a file in every room, each including what lies below it.
sound_house() {
  house=$scratch/house
  rm -rf "$house"
  put engine/base/a.h '#pragma once' '#include <vector>' 'inline std::vector<int> a() { return {}; }'
  put engine/base/parallel.h '#pragma once' '#include <oneapi/tbb/parallel_for.h>'
  put engine/model/scene.h '#pragma once' '#include "engine/base/a.h"'
  put engine/search/grid.h '#pragma once' '#include "engine/base/a.h"'
  put engine/contact/law.h '#pragma once' '#include "engine/base/a.h"'
  put engine/dem/state.h '#pragma once' '#include "engine/contact/law.h"' '#include "engine/search/grid.h"'
  put engine/generate/drop.h '#pragma once' '#include "engine/dem/state.h"' '// never tbb::parallel_for here'
  put engine/measure/phi.h '#pragma once' '#include "engine/search/grid.h"' 'inline const char* text() { return "H5Fopen("; }'
  put engine/schedule/graph.h '#pragma once' '#include "engine/generate/drop.h"' '#include "engine/measure/phi.h"'
  put engine/schedule/graph.cpp '#include "engine/schedule/graph.h"' '#include <oneapi/tbb/flow_graph.h>'
  put store/db.cpp '#include <sqlite3.h>' '#include <hdf5.h>' '#include <nlohmann/json.hpp>' '#include "engine/model/scene.h"'
  put store/db.h '#pragma once' '#include "engine/model/scene.h"'
  put campaigns/read.cpp '#include <nlohmann/json.hpp>' '#include "engine/model/scene.h"'
  put report/table.h '#pragma once' '#include "store/db.h"'
  put campaigns/cli/run.cpp '#include <CLI/CLI.hpp>' '#include "engine/schedule/graph.h"' '#include "report/table.h"'
  put tests/engine/base/a_test.cpp '#include "engine/base/a.h"' '#include <oneapi/tbb/parallel_for.h>'
  local folder
  for folder in engine/{base,model,search,contact,dem,generate,measure,schedule} store campaigns report campaigns/cli tests; do
    put "$folder/README.md" "# $folder"
  done
  put CMakeLists.txt '# empty'
  put LICENSE 'free'
  put build/left-over.txt 'not part of the house'
}

# expect NAME TEXT: floors must fail and print a line that contains TEXT. An empty TEXT: floors must pass.
expect() {
  local output status
  output=$("$floors" --root "$house" --cache "$scratch/cache" --jobs 2 2>&1)
  status=$?
  if [[ -z $2 && $status -eq 0 ]] || [[ -n $2 && $status -eq 1 && $output == *"$2"* ]]; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    printf 'FAILED: %s\n  expected: %s\n  exit %s, output:\n%s\n' "$1" "${2:-no breach}" "$status" "$output"
  fi
}

# breach NAME TEXT FILE LINE...: plants FILE in a sound house and expects TEXT.
breach() {
  sound_house
  put "${@:3}"
  expect "$1" "$2"
}

sound_house
expect 'a sound house passes' ''
expect 'a sound house passes again, from the cache' ''

h='#pragma once'
breach 'upwards' 'engine/model/x.h:2: [floors]' engine/model/x.h "$h" '#include "engine/search/grid.h"'
breach 'the ground includes nothing' 'engine/base/x.h:2: [floors]' engine/base/x.h "$h" '#include "engine/model/scene.h"'
breach 'contact sees search' 'engine/contact/x.h:2: [floors]' engine/contact/x.h "$h" '#include "engine/search/grid.h"'
breach 'search sees contact' 'engine/search/x.h:2: [floors]' engine/search/x.h "$h" '#include "engine/contact/law.h"'
breach 'search sees a Scene' 'engine/search/x.h:3: [floors]' engine/search/x.h "$h" '' '#include "engine/model/scene.h"'
breach 'measure sees generate' 'engine/measure/x.cpp:1: [floors]' engine/measure/x.cpp '#include "engine/generate/drop.h"'
breach 'generate sees measure' 'engine/generate/x.cpp:1: [floors]' engine/generate/x.cpp '#include "engine/measure/phi.h"'
breach 'store sees floor 2' 'store/x.h:2: [floors]' store/x.h "$h" '#include "engine/search/grid.h"'
breach 'campaigns see the store' 'campaigns/x.h:2: [floors]' campaigns/x.h "$h" '#include "store/db.h"'
breach 'an include of nothing' 'report/x.h:2: [includes]' report/x.h "$h" '#include "campaigns/y.h"'
sound_house
put campaigns/y.h "$h"
put report/x.h "$h" '#include "campaigns/y.h"'
expect 'report sees campaigns' 'report/x.h:2: [floors]'
sound_house
put campaigns/cli/y.h "$h"
put campaigns/x.cpp '#include "campaigns/cli/y.h"'
expect 'campaigns include the top' 'campaigns/x.cpp:1: [floors] campaigns may not include campaigns/cli/y.h'
sound_house
put tests/support/y.h "$h"
put engine/base/x.cpp '#include "tests/support/y.h"'
expect 'the program includes a test' 'engine/base/x.cpp:1: [floors]'
breach 'a file in no room' 'engine/attic/x.h:1: [floors]' engine/attic/x.h "$h"
breach 'an include from beside' 'engine/base/x.cpp:1: [includes]' engine/base/x.cpp '#include "a.h"'

sound_house
put engine/base/x.h "$h" '#include "engine/base/y.h"'
put engine/base/y.h "$h" '#include "engine/base/z.h"'
put engine/base/z.h "$h" '' '#include "engine/base/x.h"'
expect 'a cycle' 'engine/base/z.h:3: [cycle] engine/base/x.h -> engine/base/y.h -> engine/base/z.h -> engine/base/x.h'

breach 'a TBB algorithm elsewhere in base' 'engine/base/x.h:2: [libraries]' engine/base/x.h "$h" '#include <tbb/parallel_for.h>'
breach 'a TBB algorithm in the scheduler' 'engine/schedule/x.cpp:1: [libraries]' engine/schedule/x.cpp '#include <oneapi/tbb/parallel_reduce.h>'
breach 'all of TBB' 'engine/schedule/x.cpp:1: [libraries]' engine/schedule/x.cpp '#include <oneapi/tbb.h>'
breach 'a TBB algorithm by name' 'engine/generate/x.cpp:2: [libraries]' engine/generate/x.cpp '#include "engine/base/parallel.h"' \
  'void f() { oneapi::tbb::parallel_for(0, 1, [](int) {}); }'
breach 'TBB in the model' 'engine/model/x.h:2: [libraries]' engine/model/x.h "$h" '#include <oneapi/tbb/concurrent_vector.h>'
breach 'a flow graph outside the scheduler' 'campaigns/cli/x.cpp:1: [libraries]' campaigns/cli/x.cpp '#include <oneapi/tbb/flow_graph.h>'
breach 'a flow graph by name' 'campaigns/cli/x.cpp:2: [libraries]' campaigns/cli/x.cpp '' 'void f(oneapi::tbb::flow::graph&);'
breach 'SQLite outside the store' 'report/x.cpp:1: [libraries]' report/x.cpp '#include <sqlite3.h>'
breach 'SQLiteCpp outside the store' 'campaigns/cli/x.cpp:1: [libraries]' campaigns/cli/x.cpp '#include <SQLiteCpp/SQLiteCpp.h>'
breach 'HDF5 outside the store' 'engine/generate/x.cpp:1: [libraries]' engine/generate/x.cpp '#include <hdf5.h>'
breach 'JSON in the engine' 'engine/model/x.cpp:1: [libraries]' engine/model/x.cpp '#include <nlohmann/json.hpp>'
breach 'the log in a library' 'store/x.cpp:1: [libraries]' store/x.cpp '#include <spdlog/spdlog.h>'
breach 'provenance below the top' 'store/x.cpp:1: [libraries]' store/x.cpp '#include "tamp_build_info.h"'

breach 'a header that forgot an include' 'engine/base/x.h:1: [header]' engine/base/x.h "$h" 'inline std::string s() { return {}; }'
sound_house
put engine/base/a.h "$h" '// changed: no function a() any more'
put engine/model/y.h "$h" '#include "engine/base/a.h"' 'inline auto b() { return a(); }'
expect 'a header broken by a change below it' 'engine/model/y.h:1: [header]'

breach 'a stray file at the top' 'notes.txt: [top level]' notes.txt 'x'
breach 'a stray folder at the top' 'src: [top level]' src/x.txt 'x'
sound_house
rm "$house/store/README.md"
expect 'a room without README' 'store: [readme]'
breach 'a subfolder without README' 'engine/generate/drop_and_roll: [readme]' engine/generate/drop_and_roll/x.h "$h"

echo "floors_test: $passed passed, $failed failed"
[[ $failed -eq 0 && $passed -gt 0 ]]

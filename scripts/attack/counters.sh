#!/usr/bin/env bash
# rustc with the counters of libFuzzer in our own crates alone (as RUSTC_WRAPPER): what they call is built as it always is.
case " $* " in
    *" --crate-name rockfrag "* | *" --crate-name importers "* | *" --crate-name configs "* | *" --crate-name tables "*)
        exec "$@" --cfg fuzzing -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
            -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
            -Cllvm-args=-sanitizer-coverage-trace-compares
        ;;
esac
exec "$@"

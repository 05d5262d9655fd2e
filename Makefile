# The stages one by one, each made again only when what it reads has changed:
#     make                 the comparison with the paper, and the report
#     make out/pex.parquet one file and what it needs
#     make check           all that must hold before a change lands
#     make test            the tests of Rust
#     make wheel           the Python package, with the command: a wheel in target/dist
#     make check-wheel     its tests, and README and docs, from that wheel in a new environment without a compiler
#     make archive crates checksums    the rest of a release: the program, both crates, SHA256SUMS
#     make check-exports   OpenQuake and pelicun read what export writes (1.5 GB for the time of the check)
#     make spread          the numbers over twenty seeds that are shipped in data/
#     make universal       the fragility surface that is shipped, of data/records.csv: AT2=folder; without it, that of
#                          synthetic motions
#     make picture         docs/report.png, the head of the report (chromium, selenium), and docs/cabinet.svg
#     make peers           the table of speeds in docs/review/speed.md
# `rockfrag run` does the same from pipeline.yaml alone. A stage leaves a table that is up to date as it is; touching it
# tells make so.

EXE := $(if $(filter Windows_NT,$(OS)),.exe)
PROGRAM := target/release/rockfrag$(EXE)
ROCKFRAG ?= $(PROGRAM)
OUT := out
DIST := target/dist
VENV := target/venv
BIN := $(VENV)/$(if $(EXE),Scripts,bin)

# Another ROCKFRAG, a path or a command of the PATH, is used as it is.
BUILT := $(filter $(PROGRAM),$(ROCKFRAG))

# Of Linux a release has manylinux_2_28, and its crates are published.
COMPATIBILITY ?= pypi
CRATES ?= package --no-verify --allow-dirty

.PHONY: all check test wheel check-wheel archive crates checksums
.PHONY: check-exports spread universal picture peers clean

all: $(OUT)/paper.parquet $(OUT)/report.html

$(PROGRAM): Cargo.toml Cargo.lock $(shell find src data core -type f)
	cargo build --release --locked --bin rockfrag

$(OUT)/scenarios.parquet: pipeline.yaml | $(BUILT)
	$(ROCKFRAG) sample-scenarios --config pipeline.yaml --out $@ && touch $@

$(OUT)/motions.parquet: $(OUT)/scenarios.parquet
	$(ROCKFRAG) synthesize-motions --config pipeline.yaml --in $< --out $@ && touch $@

$(OUT)/responses.parquet: $(OUT)/motions.parquet
	$(ROCKFRAG) simulate --config pipeline.yaml --in $< --out $@ && touch $@

$(OUT)/pex.parquet $(OUT)/pro.parquet: $(OUT)/%.parquet: $(OUT)/responses.parquet
	$(ROCKFRAG) fit-$* --config pipeline.yaml --in $< --out $@ && touch $@

$(OUT)/paper.parquet: $(OUT)/pex.parquet $(OUT)/pro.parquet
	$(ROCKFRAG) compare-paper --pex $(OUT)/pex.parquet --pro $(OUT)/pro.parquet --out $@ && touch $@

$(OUT)/report.html: $(OUT)/paper.parquet
	$(ROCKFRAG) report --in $(OUT) --out $@

check:
	.ci/run

test:
	cargo test --release --locked

wheel:
	rm -f $(DIST)/*.whl
	python3 -m venv $(VENV)
	$(BIN)/python -m pip wheel --quiet --no-deps --wheel-dir $(DIST) ./python \
	    --config-settings build-args="--locked --compatibility $(COMPATIBILITY)"

check-wheel:
	python3 -m venv --clear $(VENV)
	$(BIN)/python -m pip install --quiet --only-binary :all: "$$(ls $(DIST)/*.whl)[test]"
	$(BIN)/python -m pytest --quiet python
	python3 scripts/check_docs.py $(BIN)

archive: $(PROGRAM)
	mkdir -p $(DIST)
	name=rockfrag-$$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml)-$$(rustc -vV | sed -n 's/^host: //p') && \
	    tar -czf $(DIST)/$$name.tar.gz README.md LICENSE-* -C $(dir $<) $(notdir $<)

crates:
	cargo $(CRATES) --locked --package rockfrag-core --package rockfrag

checksums:
	cd $(DIST) && sha256sum rockfrag-* > SHA256SUMS

check-exports: | $(BUILT)
	scripts/check_exports.sh $(ROCKFRAG)

spread: | $(BUILT)
	python3 scripts/seed_spread.py $(ROCKFRAG)

universal: | $(BUILT)
	scripts/universal/make.sh $(ROCKFRAG) $(OUT)/universal $(AT2)

picture: $(OUT)/report.html | $(BUILT)
	$(ROCKFRAG) evaluate --width 0.5 --height 1.9 --over pgv --out docs/cabinet.svg --force > /dev/null
	python3 scripts/browser.py $(OUT)/report.html --into $(OUT) --head docs/report.png

peers: | $(BUILT)
	python3 scripts/peers/table.py $(ROCKFRAG)

clean:
	rm -rf $(OUT)

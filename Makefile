# The stages one by one, each made again only when what it reads has changed:
#     make                 the comparison with the paper, and the report
#     make out/pex.parquet one file and what it needs
#     make check           all that must hold before a change lands
#     make check-docs      the commands of README and docs
#     make check-exports   OpenQuake and pelicun read what export writes (1.5 GB for the time of the check)
#     make spread          the numbers over twenty seeds that are shipped in data/
#     make universal       the fragility surface that is shipped, of data/records.csv: AT2=folder; without it, that of
#                          synthetic motions
#     make picture         the head of the report in docs/report.png (chromium, selenium)
#     make peers           the table of speeds in docs/review/speed.md
# `rockfrag run` does the same from pipeline.yaml alone. A stage leaves a table that is up to date as it is; touching it
# tells make so.

ROCKFRAG ?= target/release/rockfrag
OUT := out

# Another ROCKFRAG, a path or a command of the PATH, is used as it is.
BUILT := $(filter target/release/rockfrag,$(ROCKFRAG))

.PHONY: all check check-docs check-exports spread universal picture peers clean

all: $(OUT)/paper.parquet $(OUT)/report.html

target/release/rockfrag: Cargo.toml Cargo.lock $(shell find src data core -type f)
	cargo build --release --locked

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

check-docs: | $(BUILT)
	python3 scripts/check_docs.py $(ROCKFRAG)

check-exports: | $(BUILT)
	scripts/check_exports.sh $(ROCKFRAG)

spread: | $(BUILT)
	python3 scripts/seed_spread.py $(ROCKFRAG)

universal: | $(BUILT)
	scripts/universal/make.sh $(ROCKFRAG) $(OUT)/universal $(AT2)

picture: $(OUT)/report.html
	python3 scripts/browser.py $(OUT)/report.html --into $(OUT) --head docs/report.png

peers: | $(BUILT)
	python3 scripts/peers/table.py $(ROCKFRAG)

clean:
	rm -rf $(OUT)

# The stages one by one, each made again only when what it reads has changed:
#     make                 the comparison with the paper, and the report
#     make out/pex.parquet one file and what it needs
#     make spread          the spread over seeds that is shipped in data/
#     make universality    how the curves of one structure do on others, shipped in data/ too
#     make universal       the fragility surface that is shipped in the program
#     make book            the documentation, into target/book
#     make check-docs      what README and docs print, run again
# `rockfrag run` does the same from pipeline.yaml alone. A stage that finds its file up to date leaves it as it is;
# touching it tells make so.

ROCKFRAG ?= target/release/rockfrag
CALL := $(ROCKFRAG) --config pipeline.yaml
OUT := out

.PHONY: all spread universality universal picture book check-docs check-exports check-report sbom unsafe attack test clean

all: $(OUT)/paper.parquet $(OUT)/report.html

$(ROCKFRAG): Cargo.toml Cargo.lock $(shell find src data -type f)
	cargo build --release --locked

$(OUT)/scenarios.parquet: pipeline.yaml | $(ROCKFRAG)
	$(CALL) sample-scenarios --out $@ && touch $@

$(OUT)/motions.parquet: $(OUT)/scenarios.parquet
	$(CALL) synthesize-motions --in $< --out $@ && touch $@

$(OUT)/responses.parquet: $(OUT)/motions.parquet
	$(CALL) simulate --in $< --out $@ && touch $@

$(OUT)/pex.parquet: $(OUT)/responses.parquet
	$(CALL) fit-pex --in $< --out $@ && touch $@

$(OUT)/pro.parquet: $(OUT)/responses.parquet
	$(CALL) fit-pro --in $< --out $@ && touch $@

$(OUT)/paper.parquet: $(OUT)/pex.parquet $(OUT)/pro.parquet $(OUT)/responses.parquet
	$(CALL) compare-paper --pex $(OUT)/pex.parquet --pro $(OUT)/pro.parquet --responses $(OUT)/responses.parquet --out $@
	touch $@

$(OUT)/report.html: $(OUT)/pex.parquet $(OUT)/pro.parquet $(OUT)/paper.parquet
	$(CALL) report --in $(OUT) --out $@ && touch $@

spread: | $(ROCKFRAG)
	$(ROCKFRAG) seed-spread data/seed_spread.yaml --seeds 20 --out data/seed_spread.csv

universality: | $(ROCKFRAG)
	$(ROCKFRAG) run data/universality.yaml --out $(OUT)/universality
	python3 scripts/universality_summary.py $(OUT)/universality/universality.parquet data/universality.csv

universal: | $(ROCKFRAG)
	scripts/universal/make.sh $(ROCKFRAG) $(OUT)/universal

picture: $(OUT)/pro.parquet
	python3 scripts/readme_picture.py $(OUT) docs/fragility.png
	python3 scripts/study_pictures.py

book: | $(ROCKFRAG)
	scripts/build_docs.sh $(ROCKFRAG)

# With --update the pages get what came out.
check-docs: | $(ROCKFRAG)
	python3 scripts/check_docs.py $(ROCKFRAG)

# OpenQuake and pelicun from PyPI read what export writes: 1.5 GB for the time of the check.
check-exports: $(OUT)/pex.parquet $(OUT)/pro.parquet
	scripts/check_exports.sh $(ROCKFRAG) $(OUT)

# What a release is made of (CycloneDX), and how much unsafe code is in it.
sbom: Cargo.lock
	python3 scripts/dependencies.py sbom > rockfrag.cdx.json

unsafe: Cargo.lock
	python3 scripts/dependencies.py unsafe

# Faults of the machine, 200 times each (as root), and inputs by chance; fuzz/ has longer ones.
attack: | $(ROCKFRAG)
	python3 scripts/attack/faults.py $(ROCKFRAG) 200
	PROPTEST_CASES=100000 cargo test --release --locked --test robust

# A headless Chromium looks at the report, and at the book if it is built.
check-report: $(OUT)/report.html
	scripts/check_report.sh $(ROCKFRAG) $(OUT)

test:
	cargo test --release --locked

clean:
	rm -rf $(OUT)

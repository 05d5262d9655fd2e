FROM rust:1.95-bookworm AS build
WORKDIR /src
COPY . .
RUN cargo build --release --locked

FROM debian:bookworm-slim
COPY --from=build /src/target/release/rockfrag /usr/local/bin/
COPY --from=build /src/data /usr/share/rockfrag/data
COPY --from=build /src/pipeline.yaml /usr/share/rockfrag/
WORKDIR /work
ENTRYPOINT ["rockfrag"]
CMD ["--help"]

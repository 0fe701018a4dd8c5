# The program in an image: docker build -t freespace . && docker run -v "$PWD:/data" -w /data freespace --help
FROM debian:bookworm
COPY . /freespace
RUN bash /freespace/Examples/quickstart && rm -rf /var/lib/apt/lists/*
ENTRYPOINT ["/freespace/build/bin/freespace"]

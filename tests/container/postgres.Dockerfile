# A PostgreSQL from Debian's package, for the test of docker/compose.postgres.yaml where no registry is reachable.
ARG BASE
FROM ${BASE}
RUN printf '#!/bin/sh\nexit 101\n' > /usr/sbin/policy-rc.d && chmod +x /usr/sbin/policy-rc.d \
 && apt-get update && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends postgresql && apt-get clean \
 && ln -s /usr/lib/postgresql/*/bin /usr/lib/postgresql/bin && rm -rf /var/lib/postgresql/* && chown postgres: /var/lib/postgresql
USER postgres
ENV PATH=/usr/lib/postgresql/bin:/usr/bin:/bin
CMD ["sh", "-c", "initdb -D /var/lib/postgresql/data -U rollgait --pwfile=/run/secrets/postgres_password --auth-host=scram-sha-256 && echo host all all all scram-sha-256 >> /var/lib/postgresql/data/pg_hba.conf && exec postgres -D /var/lib/postgresql/data -c listen_addresses=* -c unix_socket_directories=/tmp"]

# A Slurm cluster of one node with Rollgait's programs on it, for the test of docker/slurm.
ARG IMAGE
FROM ${IMAGE}
USER root
RUN printf '#!/bin/sh\nexit 101\n' > /usr/sbin/policy-rc.d && chmod +x /usr/sbin/policy-rc.d \
 && apt-get update && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends slurmctld slurmd slurm-client munge \
 && apt-get clean && install -d -o munge -g munge -m 0755 /run/munge && install -d /var/spool/slurmctld /var/spool/slurmd /var/log/slurm /etc/slurm \
 && (echo IgnoreSystemd=yes; slurmd -V | awk '{split($2, v, "."); if (v[1] >= 23) print "CgroupPlugin=disabled"}') > /etc/slurm/cgroup.conf
COPY slurm.conf /etc/slurm/slurm.conf
CMD ["sh", "-c", "runuser -u munge -- munged && slurmctld && slurmd && tail -F /var/log/slurm/slurmctld.log /var/log/slurm/slurmd.log"]

import sys
from pathlib import Path

from hyperqueue import Job, LocalCluster
from hyperqueue.cluster import WorkerConfig

folder, shards = Path(sys.argv[1]).resolve(), int(sys.argv[2])
with LocalCluster(worker_config=WorkerConfig(cores=2)) as cluster:
    client = cluster.client()
    job = Job(max_fails=None)  # one that fails ends no other
    for shard in range(shards):
        line = ["perilune", "shard", str(folder), str(shard), "--workers", "1"]
        job.program(line, name=f"shard {shard}", stdout=None, stderr=None)
    client.wait_for_jobs([client.submit(job)])

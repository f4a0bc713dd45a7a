"""Campaigns: many simulated trials, or the logs of many arms; resumable, on one machine or on a cluster."""

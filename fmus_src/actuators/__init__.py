"""Actuator allocation: from demanded forces, torques and accelerations to engines, jets, gyros and wheels."""

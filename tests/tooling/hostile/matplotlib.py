"""Imports a package that the course has and workers have not."""
import matplotlib.pyplot as plt

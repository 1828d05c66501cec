"""What one can do with the course's code, or with one's own labs: each app has a README.

    bridge       programs for nvdiffrast and neural_renderer: python3 -m course run SCRIPT.py
    reconstruct  photographs to a mesh: python3 -m course reconstruct FOLDER
"""
